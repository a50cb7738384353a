#pragma once

#include <cmath>

#include "sluice/v1/scene.pb.h"

namespace sluice::client {

inline v1::Vec3 vector(double x, double y, double z) {
  v1::Vec3 result;
  result.set_x(x);
  result.set_y(y);
  result.set_z(z);
  return result;
}

/// a + scale·b.
inline v1::Vec3 sum(const v1::Vec3& a, const v1::Vec3& b, double scale) {
  return vector(a.x() + scale * b.x(), a.y() + scale * b.y(), a.z() + scale * b.z());
}

inline v1::Vec3 scaled(const v1::Vec3& a, double scale) { return vector(scale * a.x(), scale * a.y(), scale * a.z()); }

inline double dot(const v1::Vec3& a, const v1::Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }

inline double length(const v1::Vec3& a) { return std::sqrt(dot(a, a)); }

inline v1::Vec3 cross(const v1::Vec3& a, const v1::Vec3& b) {
  return vector(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
}

}  // namespace sluice::client
