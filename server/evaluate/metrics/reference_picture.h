#pragma once

#include <vector>

#include <Eigen/Core>

#include "metrics/mask.h"
#include "metrics/sight.h"
#include "shapes/surface.h"

namespace sluice::evaluate {

/// What a perfect picture of a surface would hold, pixel by pixel.
struct ReferencePicture {
  Sight sight;
  Mask liquid;
  std::vector<double> depths;            ///< Eye depth z, m; 0 where there is no liquid.
  std::vector<Eigen::Vector3f> normals;  ///< Unit, in view space, towards the eye.
  std::vector<float> cosines;            ///< Between the normal and the line of sight.
  std::vector<float> curvatures;         ///< κ1 + κ2, 1/m; negative where convex.

  /// Pixels by which normals and depths are judged: the liquid without what is seen at a cosine below 0.3, and without
  /// `margin` pixels around that, around every outline, and around every step of depth by more than `edge` (m).
  Mask interior(int margin, double edge) const;
};

/// One line of sight through every pixel's middle, traced on all OpenMP threads.
ReferencePicture traceReference(const Surface& surface, const Sight& sight);

}  // namespace sluice::evaluate
