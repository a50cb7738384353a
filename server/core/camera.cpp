#include "sluice/core/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace sluice::core {

ViewBasis viewBasis(const Camera& camera) {
  using Eigen::Vector3f;
  Vector3f forward = camera.target - camera.eye;
  const float distance = forward.norm();
  forward = distance > 0.0F ? Vector3f(forward / distance) : Vector3f(-Vector3f::UnitZ());

  Vector3f right = forward.cross(camera.up);
  // Below this sine the cross product is mostly rounding error.
  constexpr float kParallel = 1e-5F;
  if (right.norm() <= kParallel * camera.up.norm()) {
    const Vector3f other = std::abs(forward.y()) < 0.9F ? Vector3f::UnitY() : Vector3f(-Vector3f::UnitZ());
    right = forward.cross(other);
  }
  right.normalize();
  return {right, right.cross(forward), forward};
}

Camera framingCamera(const Eigen::Vector3f& boundsMin, const Eigen::Vector3f& boundsMax, float verticalFovDegrees) {
  const Eigen::Vector3f centre = 0.5F * (boundsMin + boundsMax);
  const float radius = std::max(0.5F * (boundsMax - boundsMin).norm(), 1e-3F);
  const float halfAngle = 0.5F * verticalFovDegrees * std::numbers::pi_v<float> / 180.0F;
  // The bounding sphere touches the top and bottom of the picture.
  const float distance = radius / std::sin(halfAngle);
  const Eigen::Vector3f direction = Eigen::Vector3f(0.55F, 0.42F, 0.9F).normalized();
  return {centre + distance * direction, centre, Eigen::Vector3f::UnitY(), verticalFovDegrees};
}

}  // namespace sluice::core
