#include "sluice/solids/mass_properties.h"

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"

namespace sluice::solids {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Triangles = std::vector<std::array<Vector3d, 3>>;

MassProperties ofBox(const Vector3d& size) {
  const double volume = size.prod();
  const Vector3d squares = size.cwiseAbs2();
  return {volume, Vector3d::Zero(), (volume / 12 * (Vector3d::Constant(squares.sum()) - squares)).asDiagonal()};
}

MassProperties ofSphere(double radius) {
  const double volume = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
  return {volume, Vector3d::Zero(), 0.4 * volume * radius * radius * Matrix3d::Identity()};
}

MassProperties ofCylinder(double radius, double height) {
  const double volume = std::numbers::pi * radius * radius * height;
  const double across = volume * (3 * radius * radius + height * height) / 12;
  return {volume, Vector3d::Zero(), Vector3d(across, 0.5 * volume * radius * radius, across).asDiagonal()};
}

/// Whether every edge runs once each way.
bool faceTheSameWay(const Triangles& triangles) {
  using Point = std::array<double, 3>;
  const auto key = [](const Vector3d& p) { return Point{p.x(), p.y(), p.z()}; };
  std::set<std::pair<Point, Point>> edges;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edges.emplace(key(t[k]), key(t[(k + 1) % 3])).second) return false;
    }
  }
  return true;
}

/// Sums over the tetrahedra between the origin and each triangle, signed by which way it faces: their covariances are
/// that of one tetrahedron, mapped [Blow & Binstock 2004, How to find the inertia tensor of a 3D solid body].
MassProperties ofMesh(const Triangles& triangles) {
  const Matrix3d canonical = (Matrix3d::Identity() + Matrix3d::Ones()) / 120;
  double volume = 0;
  Vector3d moment = Vector3d::Zero();
  Matrix3d covariance = Matrix3d::Zero();
  for (const auto& [a, b, c] : triangles) {
    Matrix3d corners;
    corners << a, b, c;
    const double determinant = corners.determinant();
    volume += determinant / 6;
    moment += determinant / 24 * (a + b + c);
    covariance += determinant * corners * canonical * corners.transpose();
  }
  // Triangles that all face inwards give everything with the other sign.
  const double sign = volume < 0 ? -1 : 1;
  MassProperties result;
  result.volume = sign * volume;
  result.centre = moment / volume;
  covariance = sign * covariance - result.volume * result.centre * result.centre.transpose();
  result.inertia = covariance.trace() * Matrix3d::Identity() - covariance;
  return result;
}

}  // namespace

MassProperties massPropertiesOf(const v1::Body& body, const BodyShape& shape, const std::string& fieldPath) {
  if (!shape.isClosed()) {
    throw core::InputError("", fieldPath, "only a body with a closed surface has the volume that its mass comes from");
  }
  switch (body.shape_case()) {
    case v1::Body::kSphere:
      return ofSphere(body.sphere().radius());
    case v1::Body::kCylinder:
      return ofCylinder(body.cylinder().radius(), body.cylinder().height());
    case v1::Body::kMesh:
      break;
    default:
      return ofBox(scene::toVector(body.box().size()));
  }
  const Triangles triangles = shape.triangles();
  if (!faceTheSameWay(triangles)) {
    throw core::InputError("", fieldPath, "the mesh's triangles do not all face the same way: it has no volume");
  }
  const MassProperties result = ofMesh(triangles);
  if (!(result.volume > 0)) throw core::InputError("", fieldPath, "the mesh encloses no volume");
  return result;
}

}  // namespace sluice::solids
