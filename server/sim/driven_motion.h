#pragma once

#include <Eigen/Geometry>

#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// Whether a body is driven anywhere at all.
bool moves(const v1::Body& body);

/// Where a body that starts at `start` is driven to by `time`, s: a function of time alone, so that it needs no state.
Eigen::Isometry3d drivenPose(const v1::Driven& driven, const Eigen::Isometry3d& start, double time);

/// Velocity, m/s, and spin, rad/s, that lead from one pose to another in `seconds`.
Eigen::Matrix<double, 6, 1> twistBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double seconds);

/// Bound on the speed of any point within `radius` of the body's middle, m/s; 0 where it rests until `time`.
double drivenSpeed(const v1::Driven& driven, double radius, double time);

}  // namespace sluice::sim
