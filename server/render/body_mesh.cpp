#include "body_mesh.h"

#include <cmath>
#include <numbers>

namespace sluice::render {

namespace {

using Eigen::Vector3f;

/// Facets around a cylinder: a chord of 1/96 turn is within 0.06 % of its arc, less than half a pixel where the radius
/// fills a picture of 800 rows.
constexpr int kAround = kFacetsAround.back();

/// Position at `turn` of `turns` around y, on the unit circle. Exact at whole turns, so that seams close.
Vector3f around(int turn, int turns) {
  const double angle = 2 * std::numbers::pi * (turn % turns) / turns;
  return {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
}

std::uint32_t add(BodyMesh& mesh, const Vector3f& position, const Vector3f& normal) {
  mesh.vertices.push_back({position, normal});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void addQuad(BodyMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// A circle of radius `r` at height `y`; normals along `up`, ±y.
void addLid(BodyMesh& mesh, float r, float y, float up) {
  const Vector3f normal(0, up, 0);
  const std::uint32_t middle = add(mesh, {0, y, 0}, normal);
  for (int i = 0; i < kAround; ++i) add(mesh, r * around(i, kAround) + Vector3f(0, y, 0), normal);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t here = middle + 1 + i;
    const std::uint32_t next = middle + 1 + (i + 1) % kAround;
    mesh.triangles.push_back({middle, up > 0 ? here : next, up > 0 ? next : here});
  }
}

Vector3f toVector(const v1::Vec3& v) { return Eigen::Vector3d(v.x(), v.y(), v.z()).cast<float>(); }

/// Angle at a of the triangle a, b, c.
float angleAt(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  const Vector3f u = b - a;
  const Vector3f v = c - a;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

BodyMesh makeBox(const v1::BoxShape& box) {
  BodyMesh mesh;
  const Vector3f half = 0.5F * toVector(box.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      if (box.open_top() && axis == 1 && side > 0) continue;
      const Vector3f normal = side * Vector3f::Unit(axis);
      const Vector3f u = Vector3f::Unit((axis + 1) % 3);
      const Vector3f v = normal.cross(u);
      const auto corner = [&](float x, float y) {
        return add(mesh, (normal + x * u + y * v).cwiseProduct(half), normal);
      };
      const std::uint32_t a = corner(-1, -1);
      const std::uint32_t b = corner(1, -1);
      const std::uint32_t c = corner(1, 1);
      addQuad(mesh, a, b, c, corner(-1, 1));
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3f along = Vector3f::Unit(axis);
    for (const float s : {-1.0F, 1.0F}) {
      for (const float t : {-1.0F, 1.0F}) {
        const Vector3f middle = s * Vector3f::Unit((axis + 1) % 3) + t * Vector3f::Unit((axis + 2) % 3);
        mesh.rims.push_back({(middle - along).cwiseProduct(half), (middle + along).cwiseProduct(half)});
      }
    }
  }
  return mesh;
}

BodyMesh makeSphere(const v1::SphereShape& sphere, int facetsAround) {
  BodyMesh mesh;
  const auto radius = static_cast<float>(sphere.radius());
  const int rows = facetsAround / 2;
  for (int row = 0; row <= rows; ++row) {
    const double polar = std::numbers::pi * row / rows;
    // Exactly at the poles, so that the sphere is closed.
    const double ring = row == 0 || row == rows ? 0 : std::sin(polar);
    for (int i = 0; i <= facetsAround; ++i) {
      Vector3f normal = static_cast<float>(ring) * around(i, facetsAround);
      normal.y() = static_cast<float>(std::cos(polar));
      add(mesh, radius * normal, normal.normalized());
    }
  }
  const auto across = static_cast<std::uint32_t>(facetsAround);
  const auto down = static_cast<std::uint32_t>(rows);
  for (std::uint32_t row = 0; row < down; ++row) {
    for (std::uint32_t i = 0; i < across; ++i) {
      const std::uint32_t upper = row * (across + 1) + i;
      const std::uint32_t lower = upper + across + 1;
      if (row + 1 < down) mesh.triangles.push_back({upper, lower, lower + 1});
      if (row > 0) mesh.triangles.push_back({upper, lower + 1, upper + 1});
    }
  }
  return mesh;
}

BodyMesh makeCylinder(const v1::CylinderShape& cylinder) {
  BodyMesh mesh;
  const auto radius = static_cast<float>(cylinder.radius());
  const Vector3f up(0, 0.5F * static_cast<float>(cylinder.height()), 0);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const Vector3f normal = around(static_cast<int>(i), kAround);
    add(mesh, radius * normal - up, normal);
    add(mesh, radius * normal + up, normal);
    const std::uint32_t next = 2 * ((i + 1) % kAround);
    addQuad(mesh, 2 * i, next, next + 1, 2 * i + 1);
  }
  addLid(mesh, radius, -up.y(), -1);
  if (!cylinder.open_top()) addLid(mesh, radius, up.y(), 1);
  for (const Vector3f& height : {Vector3f(-up), up}) {
    BodyRim& rim = mesh.rims.emplace_back();
    for (int i = 0; i <= kAround; ++i) rim.push_back(radius * around(i, kAround) + height);
  }
  return mesh;
}

BodyMesh makeMesh(const particleio::TriangleMesh& file, float scale) {
  BodyMesh mesh;
  mesh.triangles = file.triangles;
  std::vector<Vector3f> means(file.positions.size(), Vector3f::Zero());
  for (const auto& triangle : file.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3f& a = file.positions[triangle[k]];
      const Vector3f& b = file.positions[triangle[(k + 1) % 3]];
      const Vector3f& c = file.positions[triangle[(k + 2) % 3]];
      means[triangle[k]] += angleAt(a, b, c) * (b - a).cross(c - a).stableNormalized();
    }
  }
  for (std::size_t i = 0; i < file.positions.size(); ++i) {
    const bool given = !file.normals.empty() && file.normals[i].squaredNorm() > 0.25F;
    add(mesh, scale * file.positions[i], given ? file.normals[i] : means[i].stableNormalized().eval());
  }
  return mesh;
}

Eigen::Isometry3f poseOf(const core::BodyPose& pose) {
  Eigen::Isometry3f result = Eigen::Isometry3f::Identity();
  result.translate(pose.position);
  result.rotate(pose.rotation.normalized());
  return result;
}

}  // namespace sluice::render
