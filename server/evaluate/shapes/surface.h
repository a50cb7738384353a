#pragma once

#include <optional>

#include <Eigen/Core>

namespace sluice::evaluate {

/// Where a line of sight meets a surface.
struct Hit {
  double distance = 0;                                ///< Along the line, m.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Unit, out of the liquid.
  double curvature = 0;                               ///< κ1 + κ2, 1/m; negative where convex: −2/R on a ball.
};

/// A surface that pictures of it are compared with.
class Surface {
 public:
  virtual ~Surface() = default;

  /// The first point where the line from `eye` along the unit vector `direction` enters the liquid. Thread-safe.
  virtual std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const = 0;
};

}  // namespace sluice::evaluate
