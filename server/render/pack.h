#pragma once

#include <array>

#include <Eigen/Core>

#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Three components and a fourth as std140 lays out a vec4.
inline std::array<float, 4> pack(const Eigen::Vector3f& v, float w) { return {v.x(), v.y(), v.z(), w}; }

inline std::array<float, 4> pack(const v1::Vec3& v, double w = 0) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), static_cast<float>(w)};
}

}  // namespace sluice::render
