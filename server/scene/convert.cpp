#include "sluice/scene/convert.h"

#include <numbers>

namespace sluice::scene {

Eigen::Vector3d toVector(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

v1::Vec3 fromVector(const Eigen::Vector3d& v) {
  v1::Vec3 message;
  message.set_x(v.x());
  message.set_y(v.y());
  message.set_z(v.z());
  return message;
}

core::Camera toCamera(const v1::Camera& camera) {
  return {toVector(camera.eye()).cast<float>(), toVector(camera.target()).cast<float>(),
          toVector(camera.up()).cast<float>(), static_cast<float>(camera.vertical_fov_degrees())};
}

v1::Camera fromCamera(const core::Camera& camera) {
  v1::Camera message;
  *message.mutable_eye() = fromVector(camera.eye.cast<double>());
  *message.mutable_target() = fromVector(camera.target.cast<double>());
  *message.mutable_up() = fromVector(camera.up.cast<double>());
  message.set_vertical_fov_degrees(camera.verticalFovDegrees);
  return message;
}

Eigen::Isometry3f toPose(const v1::Body& body) {
  using Eigen::Vector3f;
  const Vector3f turn = static_cast<float>(std::numbers::pi / 180) * toVector(body.rotation_degrees()).cast<float>();
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.translate(toVector(body.position()).cast<float>());
  pose.rotate(Eigen::AngleAxisf(turn.z(), Vector3f::UnitZ()) * Eigen::AngleAxisf(turn.y(), Vector3f::UnitY()) *
              Eigen::AngleAxisf(turn.x(), Vector3f::UnitX()));
  return pose;
}

}  // namespace sluice::scene
