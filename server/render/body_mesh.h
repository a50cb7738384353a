#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "sluice/core/particle_snapshot.h"
#include "sluice/particleio/mesh_file.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

struct BodyVertex {
  Eigen::Vector3f position;  ///< m, about the body's middle.
  Eigen::Vector3f normal;    ///< Unit.
};

/// Where two panes of glass meet, or one ends: a chain of straight pieces.
using BodyRim = std::vector<Eigen::Vector3f>;

/// A body's surface. Triangles are counter-clockwise as seen from outside.
struct BodyMesh {
  std::vector<BodyVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<BodyRim> rims;  ///< None for what is smooth, or has no edges that are known.
};

/// Facets around round bodies, by how finely they are to be drawn.
inline constexpr std::array kFacetsAround{32, 56, 96};

/// Radius in pixels up to which so many facets are within about a third of a pixel of what they stand for: a chord of
/// 1/n turn is up to 1 − cos(π/n) ≈ 4.93/n² radii from its arc.
constexpr float largestRadius(int facetsAround) {
  return 0.07F * static_cast<float>(facetsAround) * static_cast<float>(facetsAround);
}

BodyMesh makeBox(const v1::BoxShape& box);
BodyMesh makeSphere(const v1::SphereShape& sphere, int facetsAround = kFacetsAround.back());
BodyMesh makeCylinder(const v1::CylinderShape& cylinder);

/// A file's triangles, `scale` m per unit. Vertices without a normal get the mean of the faces around them, weighted by
/// their angles there [Thürmer & Wüthrich 1998, Computing vertex normals from polygonal facets].
BodyMesh makeMesh(const particleio::TriangleMesh& file, float scale);

/// From a body's own axes to where it has moved to in the scene.
Eigen::Isometry3f poseOf(const core::BodyPose& pose);

}  // namespace sluice::render
