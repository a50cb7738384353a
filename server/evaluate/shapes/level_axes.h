#pragma once

#include <Eigen/Geometry>

namespace sluice::evaluate {

/// Axes of a surface that is level or nearly so: z along its unit normal, through `origin`.
inline Eigen::Isometry3d levelAxes(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal) {
  Eigen::Isometry3d axes = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitY().cross(normal).normalized();
  axes.linear() << x, normal.cross(x), normal;
  axes.translation() = origin;
  return axes;
}

/// What particles fill below a level surface that reaches up to `height`: far enough to either side that, tilted by up
/// to 45°, it still covers a picture of 45° from 4 m away.
inline Eigen::AlignedBox3d levelExtent(double height, double depth) {
  constexpr double kHalfWidth = 5.0;
  return {Eigen::Vector3d(-kHalfWidth, -kHalfWidth, height - depth), Eigen::Vector3d(kHalfWidth, kHalfWidth, height)};
}

}  // namespace sluice::evaluate
