#pragma once

#include <cstddef>
#include <vector>

#include "metrics/reference_picture.h"
#include "metrics/surface_geometry.h"

namespace sluice::evaluate {

/// How far a picture of inverse depths is from the surface that it shows.
struct SurfaceError {
  double depthRmseSpacings = 0;          ///< Distance from the true surface along its normal, in d.
  double depthRmseUnbiasedSpacings = 0;  ///< The same without its median, most of which is that splats are larger than
                                         ///< particles.
  double normalMeanDegrees = 0;
  double normalRmsDegrees = 0;
  double normalP95Degrees = 0;
  double silhouetteIou = 0;      ///< Of the outlines, in pixels of the picture.
  double hausdorffPixels = 0;    ///< Likewise.
  double curvatureResidual = 0;  ///< Mean |κ1 + κ2 − κ_ref|·d.
  std::size_t holes = 0;         ///< Pixels of the picture without liquid inside the true surface.
  /// Surface pixels that depths and normals were compared at; where there are none, their errors are NaN.
  std::size_t judgedPixels = 0;
};

/// A reference at the sizes at which a surface is compared with it.
struct Reference {
  ReferencePicture surface;  ///< At the size of the buffer of inverse depths.
  Mask pictureLiquid;        ///< At the size of the whole picture, `divisor` times as large.
  int divisor = 1;
  Mask interior;       ///< Of `surface`: 12 pixels of the picture away from every edge.
  double edge = 0;     ///< Step of eye depth that counts as an edge, m.
  double spacing = 0;  ///< d, m.
};

/// Pixels of the picture between what is judged and the next edge.
constexpr int kJudgedMargin = 12;

SurfaceError compareSurface(const std::vector<float>& q, const SurfaceGeometry& geometry, const Reference& reference);

/// RMS angle, degrees, by which the normals of the same points of the surface change between two pictures of it: every
/// judged pixel is looked up, between four pixels, where it went. Points that left the judged surface are skipped.
double flickerDegrees(const std::vector<float>& q, const SurfaceGeometry& geometry, const Reference& reference,
                      const std::vector<float>& turnedQ, const SurfaceGeometry& turnedGeometry,
                      const Sight& turnedSight);

}  // namespace sluice::evaluate
