#pragma once

#include <algorithm>

#include "splat_ellipsoids.h"
#include "view_geometry.h"

namespace sluice::render {

/// Radius that still covers a pixel's centre when a sphere shrinks below a pixel; keeps far liquid free of holes.
/// 0.75 pixels: a little more than half a pixel's diagonal.
inline float visibleRadius(float radius, float depth, float pixelSlope) {
  return std::max(radius, 0.75F * pixelSlope * depth);
}

/// A sphere in view space, wholly in front of the eye.
struct ViewSphere {
  float x, y, z;  ///< m; z > radius.
  float radius;   ///< m.
};

/// An ellipsoid in view space, see SplatEllipsoid.
struct ViewEllipsoid {
  float x, y, z;     ///< Centre, m.
  float shortest;    ///< Half axis, m.
  float xx, yy, zz;  ///< S, m².
  float xy, xz, yz;
};

/// An ellipsoid as the camera sees it.
ViewEllipsoid toView(const SplatEllipsoid& ellipsoid, const ViewGeometry& view);

/// The same sphere or ellipsoid, as large as pixels of the target need. Of an ellipsoid no half axis stays shorter than
/// visibleRadius; S grows by one multiple of the unit matrix, so that a ball becomes what a sphere of its size does.
ViewSphere widened(const ViewSphere& sphere, float pixelSlope);
ViewEllipsoid widened(const ViewEllipsoid& ellipsoid, float pixelSlope);

/// Bounds of the outline; the splat is wholly in front of the eye.
SlopeBounds boundsOf(const ViewSphere& sphere);
/// The plane x = W·z touches the ellipsoid where (c_x − W·c_z)² = (1, 0, −W)ᵀ S (1, 0, −W): a quadratic equation for W.
SlopeBounds boundsOf(const ViewEllipsoid& ellipsoid);

/// How far an ellipsoid reaches along the view axis from its centre, m.
float depthExtent(const ViewEllipsoid& ellipsoid);

/// What an ellipsoid's crossing with a line of sight w = (W, 1) takes. In the space where it is the unit sphere, both
/// depths z solve a·z² − 2m·z + room = 0 with a = wᵀQw, m = w·(Qc), room = cᵀQc − 1, Q = S⁻¹, whose discriminant is
///   D = m² − a·room = a − |Lᵀ(w × c)|²,  L·Lᵀ = S/det S (Lagrange's identity),
/// without a difference of large squares, as for spheres: w × c vanishes for the line through the centre.
struct EllipsoidRays {
  float qxx, qyy, qzz, qxy, qxz, qyz;  ///< Q, 1/m².
  float mx, my, mz;                    ///< Qc, 1/m.
  float l11, l21, l31, l22, l32, l33;  ///< L, 1/m².
  float room;
  float volume;  ///< m³.

  explicit EllipsoidRays(const ViewEllipsoid& ellipsoid);
};

}  // namespace sluice::render
