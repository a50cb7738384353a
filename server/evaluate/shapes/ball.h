#pragma once

#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "shapes/surface.h"

namespace sluice::evaluate {

struct Ball {
  Eigen::Vector3d centre;
  double radius;

  double depthBelow(const Eigen::Vector3d& point) const { return radius - (point - centre).norm(); }

  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d toCentre = centre - eye;
    const double along = toCentre.dot(direction);
    const double squared = along * along - toCentre.squaredNorm() + radius * radius;
    if (squared < 0) return std::nullopt;
    const double distance = along - std::sqrt(squared);
    if (distance < 0) return std::nullopt;
    return Hit{distance, (eye + distance * direction - centre) / radius, -2.0 / radius};
  }
};

}  // namespace sluice::evaluate
