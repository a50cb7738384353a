#pragma once

#include <Eigen/Core>

namespace sluice::core {

struct ImageSize {
  int width = 0;
  int height = 0;

  bool operator==(const ImageSize&) const = default;
};

/// A pinhole camera in world space, m. The view has x to the right, y up, and eye depth z > 0 forwards.
struct Camera {
  Eigen::Vector3f eye{2.0F, 1.5F, 3.0F};
  Eigen::Vector3f target{0.0F, 0.0F, 0.0F};
  Eigen::Vector3f up{0.0F, 1.0F, 0.0F};
  float verticalFovDegrees = 45.0F;

  bool operator==(const Camera&) const = default;
};

/// The camera's axes in world space: orthonormal, right × up = −forward.
struct ViewBasis {
  Eigen::Vector3f right;
  Eigen::Vector3f up;
  Eigen::Vector3f forward;
};

/// Falls back to another axis where `up` is parallel to the line of sight, and looks along −z where eye and target
/// coincide, so that every finite camera gives a finite basis.
ViewBasis viewBasis(const Camera& camera);

/// A camera that sees all of a box, from the front, the right and above.
Camera framingCamera(const Eigen::Vector3f& boundsMin, const Eigen::Vector3f& boundsMax,
                     float verticalFovDegrees = 45.0F);

}  // namespace sluice::core
