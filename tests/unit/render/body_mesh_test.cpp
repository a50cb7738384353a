#include "body_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "sluice/scene/convert.h"

namespace sluice::render {
namespace {

using Eigen::Vector3f;

v1::BoxShape box(double x, double y, double z, bool openTop = false) {
  v1::BoxShape shape;
  shape.mutable_size()->set_x(x);
  shape.mutable_size()->set_y(y);
  shape.mutable_size()->set_z(z);
  shape.set_open_top(openTop);
  return shape;
}

v1::CylinderShape cylinder(double radius, double height, bool openTop = false) {
  v1::CylinderShape shape;
  shape.set_radius(radius);
  shape.set_height(height);
  shape.set_open_top(openTop);
  return shape;
}

v1::SphereShape sphere(double radius) {
  v1::SphereShape shape;
  shape.set_radius(radius);
  return shape;
}

double area(const BodyMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3f& origin = mesh.vertices[a].position;
    sum += 0.5 * (mesh.vertices[b].position - origin).cross(mesh.vertices[c].position - origin).norm();
  }
  return sum;
}

/// By the divergence theorem: positive where triangles turn outwards.
double volume(const BodyMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += mesh.vertices[a].position.dot(mesh.vertices[b].position.cross(mesh.vertices[c].position)) / 6.0;
  }
  return sum;
}

/// Edges, by the places of their ends, that are not met by one triangle in either direction.
std::size_t openEdges(const BodyMesh& mesh) {
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> balance;
  const auto place = [&](std::uint32_t i) {
    const Vector3f p = mesh.vertices[i].position + Vector3f::Zero();  // −0 becomes 0
    return Place{p.x(), p.y(), p.z()};
  };
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Place a = place(triangle[k]);
      const Place b = place(triangle[(k + 1) % 3]);
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  }
  return static_cast<std::size_t>(std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

void expectOutwardNormals(const BodyMesh& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3f& origin = mesh.vertices[a].position;
    const Vector3f facet = (mesh.vertices[b].position - origin).cross(mesh.vertices[c].position - origin).normalized();
    for (const std::uint32_t i : {a, b, c}) {
      EXPECT_NEAR(mesh.vertices[i].normal.norm(), 1, 1e-5);
      EXPECT_GT(facet.dot(mesh.vertices[i].normal), 0.99);
    }
  }
}

TEST(BodyMesh, IsClosedAndTurnsOutwards) {
  for (const BodyMesh& mesh : {makeBox(box(1, 2, 3)), makeSphere(sphere(0.7)), makeCylinder(cylinder(0.5, 2))}) {
    EXPECT_EQ(openEdges(mesh), 0U);
    EXPECT_GT(volume(mesh), 0);
    expectOutwardNormals(mesh);
  }
}

TEST(BodyMesh, HasTheShapesAreaAndVolume) {
  EXPECT_NEAR(area(makeBox(box(1, 2, 3))), 22, 1e-4);
  EXPECT_NEAR(volume(makeBox(box(1, 2, 3))), 6, 1e-4);
  // Facets cut off (2π/96)²/6 of the area of a circle, and about as much of a sphere's.
  EXPECT_NEAR(volume(makeSphere(sphere(1))), 4 * std::numbers::pi / 3, 0.01);
  EXPECT_NEAR(area(makeSphere(sphere(1))), 4 * std::numbers::pi, 0.02);
  EXPECT_NEAR(volume(makeCylinder(cylinder(1, 2))), 2 * std::numbers::pi, 0.01);
  EXPECT_NEAR(area(makeCylinder(cylinder(1, 2))), 6 * std::numbers::pi, 0.02);
}

TEST(BodyMesh, OpenTopsLackJustTheirLid) {
  EXPECT_NEAR(area(makeBox(box(1, 2, 3, true))), 19, 1e-4);
  EXPECT_EQ(openEdges(makeBox(box(1, 2, 3, true))), 4U);
  EXPECT_NEAR(area(makeCylinder(cylinder(1, 2, true))), 5 * std::numbers::pi, 0.02);
}

TEST(BodyMesh, RimsLieOnTheSurface) {
  EXPECT_EQ(makeBox(box(1, 2, 3)).rims.size(), 12U);
  const BodyMesh cuboid = makeBox(box(1, 2, 3));
  for (const BodyRim& rim : cuboid.rims) {
    const Vector3f middle = 0.5F * (rim.front() + rim.back());
    // The middle of an edge touches two faces.
    EXPECT_EQ((middle.cwiseAbs() - Vector3f(0.5F, 1, 1.5F))
                  .cwiseAbs()
                  .unaryExpr([](float d) { return d < 1e-6F ? 1.0F : 0.0F; })
                  .sum(),
              2);
  }
  const BodyMesh tube = makeCylinder(cylinder(0.5, 2));
  for (const Vector3f& point : tube.rims.front()) {
    EXPECT_NEAR(std::hypot(point.x(), point.z()), 0.5, 1e-6);
  }
}

TEST(BodyMesh, WeighsNormalsByAngle) {
  // The corner of a cube, one of whose faces is cut into two: by angle the faces count alike all the same.
  particleio::TriangleMesh file;
  file.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0.5F, 0.5F}};
  file.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 4}, {0, 4, 2}};
  const BodyMesh mesh = makeMesh(file, 2);
  EXPECT_LT((mesh.vertices[0].normal - Vector3f(-1, -1, -1).normalized()).norm(), 1e-5);
  EXPECT_EQ(mesh.vertices[1].position, Vector3f(2, 0, 0));
}

TEST(BodyMesh, KeepsNormalsOfTheFile) {
  particleio::TriangleMesh file;
  file.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  file.normals = {{0, 1, 0}, {1, 0, 0}, {0, 0, 0}};
  file.triangles = {{0, 1, 2}};
  const BodyMesh mesh = makeMesh(file, 1);
  EXPECT_EQ(mesh.vertices[0].normal, Vector3f(0, 1, 0));
  EXPECT_LT((mesh.vertices[2].normal - Vector3f(0, 0, 1)).norm(), 1e-6) << "a normal without direction is made anew";
}

TEST(BodyPose, TurnsAboutXThenYThenZ) {
  v1::Body body;
  body.mutable_position()->set_x(5);
  body.mutable_rotation_degrees()->set_x(90);
  body.mutable_rotation_degrees()->set_z(90);
  // y is turned into z by the first turn, which the last leaves; x stays, then becomes y.
  const Eigen::Isometry3f pose = scene::toPose(body);
  EXPECT_LT((pose * Vector3f(0, 1, 0) - Vector3f(5, 0, 1)).norm(), 1e-6);
  EXPECT_LT((pose * Vector3f(1, 0, 0) - Vector3f(5, 1, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace sluice::render
