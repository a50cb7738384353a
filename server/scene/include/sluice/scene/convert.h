#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sluice/core/camera.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::scene {

Eigen::Vector3d toVector(const v1::Vec3& v);
v1::Vec3 fromVector(const Eigen::Vector3d& v);
core::Camera toCamera(const v1::Camera& camera);
v1::Camera fromCamera(const core::Camera& camera);

/// From a body's own axes to the scene, where the scene puts it.
Eigen::Isometry3f toPose(const v1::Body& body);

}  // namespace sluice::scene
