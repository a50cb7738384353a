#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "metrics/sight.h"

namespace sluice::evaluate {

/// Normals and curvatures of a picture of inverse depths.
struct SurfaceGeometry {
  std::vector<Eigen::Vector3f> normals;  ///< Unit, in view space, towards the eye; zero where there is no liquid.
  /// κ1 + κ2, 1/m, negative where convex; NaN where a neighbouring pixel is missing or of another surface.
  std::vector<float> curvatures;
};

/// Reads them off inverse depths q = 1/z (0: no liquid), exactly as far as differences between pixels allow:
///   N = (q_X, q_Y, q − W·∇q),
///   κ1 + κ2 = (q/|N|)·[(1+W_x²)q_XX + 2W_xW_y q_XY + (1+W_y²)q_YY − (b1²q_XX + 2b1b2 q_XY + b2²q_YY)/|N|²],
/// b = ∇q − W·N_3 (the level set q(X/Z, Y/Z)·Z = 1). Differences are central; at an edge, where the
/// eye depths of neighbours differ by more than `edge` (m), the one that stays on the surface.
SurfaceGeometry geometryOf(const std::vector<float>& q, const Sight& sight, double edge);

}  // namespace sluice::evaluate
