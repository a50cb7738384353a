#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

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

/// Draws spheres into pictures of floats on the CPU: what splats.frag and thickness.frag draw, several times as fast as
/// a software GL does.
///
/// With the line of sight W and the sphere's centre c, e = c_xy − c_z·W and k = c_x·W_y − c_y·W_x, the discriminant is
///   D = R²(1+|W|²) − |e|² − k²
/// and the front's inverse depth q = (c·(W, 1) + √D) / (|c|² − R²): every term is a difference of small numbers, and a
/// line of sight costs one root and no division.
///
/// The picture is cut into strips of rows, each of which one thread draws in the order of the spheres, so that the
/// result is the same for any number of threads. Uses the OpenMP team of the calling thread.
class SplatRaster {
 public:
  /// q = max(q, 1/z of the front) wherever a sphere is; `q` has the target's size, row by row. In both pictures a
  /// sphere is widened to what a pixel of the target needs, see visibleRadius.
  /// `rimDepth` is 0 for spheres, or where, in radii before its centre, a sphere's limb is cut to a flat rim.
  void drawDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, float rimDepth, std::span<float> q);

  /// thickness += κ·(length of the line of sight inside) for every sphere, where κ is a particle's volume, m³, over the
  /// sphere's.
  void drawThickness(std::span<const ViewSphere> spheres, const ViewGeometry& target, float particleVolume,
                     std::span<float> thickness);

 private:
  struct Bounds {
    std::int16_t left, right, top, bottom;  ///< Pixels [left, right) × [top, bottom).
  };

  void bin(std::span<const ViewSphere> spheres, const ViewGeometry& target);
  template <class DrawStrip>
  void forEachStrip(const ViewGeometry& target, const DrawStrip& drawStrip);

  std::vector<ViewSphere> spheres_;  ///< Widened.
  std::vector<Bounds> bounds_;
  std::vector<std::uint32_t> stripStart_;  ///< Strip s holds order_[stripStart_[s]] to order_[stripStart_[s + 1]].
  std::vector<std::uint32_t> order_;
  std::vector<float> columnSlopes_;  ///< W_x of every column, padded by a block.
};

}  // namespace sluice::render
