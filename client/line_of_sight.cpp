#include "sluice/client/line_of_sight.h"

#include <cmath>
#include <numbers>

#include "vectors.h"

namespace sluice::client {

namespace {

struct ViewBasis {
  v1::Vec3 right;
  v1::Vec3 up;
  v1::Vec3 forward;
};

ViewBasis viewBasis(const v1::Camera& camera) {
  v1::Vec3 forward = sum(camera.target(), camera.eye(), -1);
  const double distance = length(forward);
  forward = distance > 0 ? scaled(forward, 1 / distance) : vector(0, 0, -1);

  v1::Vec3 right = cross(forward, camera.up());
  // Below this sine the server's single precision has mostly rounding error left.
  constexpr double kParallel = 1e-5;
  if (length(right) <= kParallel * length(camera.up())) {
    right = cross(forward, std::abs(forward.y()) < 0.9 ? vector(0, 1, 0) : vector(0, 0, -1));
  }
  right = scaled(right, 1 / length(right));
  return {right, cross(right, forward), forward};
}

}  // namespace

v1::Vec3 lineOfSight(const v1::Camera& camera, const PictureSize& size, const PicturePoint& point) {
  const ViewBasis basis = viewBasis(camera);
  const double halfHeight = std::tan(0.5 * camera.vertical_fov_degrees() * std::numbers::pi / 180);
  const double halfWidth = halfHeight * size.width / size.height;
  v1::Vec3 direction = sum(basis.forward, basis.right, (2 * point.x - 1) * halfWidth);
  direction = sum(direction, basis.up, (1 - 2 * point.y) * halfHeight);
  return scaled(direction, 1 / length(direction));
}

}  // namespace sluice::client
