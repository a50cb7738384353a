#include <cmath>

#include "sluice/client/stream_benchmark.h"
#include "vectors.h"

namespace sluice::client {

v1::Camera orbited(const v1::Camera& camera, double radians) {
  const double upLength = length(camera.up());
  if (upLength == 0) return camera;
  const v1::Vec3 axis = scaled(camera.up(), 1 / upLength);
  const v1::Vec3 arm = sum(camera.eye(), camera.target(), -1);

  // Rodrigues' rotation: v cos θ + (k × v) sin θ + k (k·v)(1 − cos θ).
  const double cosine = std::cos(radians);
  v1::Vec3 turned = scaled(arm, cosine);
  turned = sum(turned, cross(axis, arm), std::sin(radians));
  turned = sum(turned, axis, dot(axis, arm) * (1 - cosine));

  v1::Camera result = camera;
  *result.mutable_eye() = sum(camera.target(), turned, 1);
  return result;
}

}  // namespace sluice::client
