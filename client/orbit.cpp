#include <cmath>

#include "sluice/client/stream_benchmark.h"

namespace sluice::client {

namespace {

v1::Vec3 vector(double x, double y, double z) {
  v1::Vec3 result;
  result.set_x(x);
  result.set_y(y);
  result.set_z(z);
  return result;
}

v1::Vec3 sum(const v1::Vec3& a, const v1::Vec3& b, double scale) {
  return vector(a.x() + scale * b.x(), a.y() + scale * b.y(), a.z() + scale * b.z());
}

double dot(const v1::Vec3& a, const v1::Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }

v1::Vec3 cross(const v1::Vec3& a, const v1::Vec3& b) {
  return vector(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
}

}  // namespace

v1::Camera orbited(const v1::Camera& camera, double radians) {
  const double upLength = std::sqrt(dot(camera.up(), camera.up()));
  if (upLength == 0) return camera;
  const v1::Vec3 axis = sum(v1::Vec3(), camera.up(), 1 / upLength);
  const v1::Vec3 arm = sum(camera.eye(), camera.target(), -1);

  // Rodrigues' rotation: v cos θ + (k × v) sin θ + k (k·v)(1 − cos θ).
  const double cosine = std::cos(radians);
  v1::Vec3 turned = sum(v1::Vec3(), arm, cosine);
  turned = sum(turned, cross(axis, arm), std::sin(radians));
  turned = sum(turned, axis, dot(axis, arm) * (1 - cosine));

  v1::Camera result = camera;
  *result.mutable_eye() = sum(camera.target(), turned, 1);
  return result;
}

}  // namespace sluice::client
