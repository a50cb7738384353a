#pragma once

#include <Eigen/Core>

#include "sluice/core/camera.h"

namespace sluice::core {

/// A line of sight, in world space.
struct Ray {
  Eigen::Vector3f origin;     ///< m.
  Eigen::Vector3f direction;  ///< Of length 1.
  Eigen::Vector3f axis;       ///< The camera's view axis, of length 1: eye depth is measured along it.
};

/// The line of sight through a point of a picture of this size: `x` from its left edge, `y` from its top, as shares of
/// its width and height.
Ray rayThrough(const Camera& camera, ImageSize size, double x, double y);

}  // namespace sluice::core
