#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "body_mesh.h"
#include "pixel_rects.h"
#include "sluice/gl/objects.h"
#include "view_geometry.h"

namespace sluice::render {

/// Triangles on the device.
struct BodyTriangles {
  gl::Buffer vertices;
  gl::Buffer indices;
  gl::VertexArray array;
  GLsizei indexCount = 0;

  explicit BodyTriangles(const BodyMesh& mesh);
};

/// A mesh, and its copies on the device: one, or for spheres one for each of kFacetsAround.
struct BodyModel {
  BodyMesh mesh;  ///< The finest.
  std::vector<BodyTriangles> levels;

  explicit BodyModel(const v1::Body& body);

  /// As finely as an outline of so many pixels' radius asks for.
  void draw(float radiusInPixels) const;
};

struct BodyInstance {
  std::shared_ptr<const BodyModel> model;
  Eigen::Isometry3f pose;
  v1::Body body;

  bool isGlass() const { return body.has_glass(); }
};

/// The bodies of a scene where they stand at the moment. Models are kept while a scene uses them.
class BodyScene {
 public:
  /// Throws core::InputError where a mesh's file cannot be read; the bodies then are what they were.
  void update(const v1::Scene& scene, std::span<const core::BodyPose> poses);

  /// Counts the changes that `update` has seen, of bodies and of the sun.
  std::uint64_t changes() const { return changes_; }
  const std::vector<BodyInstance>& bodies() const { return bodies_; }

  /// Around the bodies that are no glass; of radius 0 where there are none.
  struct Ball {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius = 0;
  };
  Ball matteBounds() const;

 private:
  std::shared_ptr<const BodyModel> modelOf(const v1::Body& body);

  std::map<std::string, std::shared_ptr<const BodyModel>> models_;  ///< By shape, serialized.
  std::vector<BodyInstance> bodies_;
  v1::Scene scene_;  ///< Bodies and lights of the last update.
  std::vector<core::BodyPose> poses_;
  std::uint64_t changes_ = 0;
};

/// Of the ball around its bounds, a body fills about this much of the radius.
inline constexpr float kContactRadius = 0.6F;

/// The ball around a model's bounding box, in the scene.
BodyScene::Ball boundsOf(const BodyInstance& body);

/// The same, but no larger than the body where that is a sphere.
BodyScene::Ball outlineOf(const BodyInstance& body);

/// Radius in pixels of the ball's outline in a view; infinite where the eye is in the ball.
float radiusInPicture(const BodyScene::Ball& ball, const ViewGeometry& view);

/// Of the model's vertices, before it is posed.
Eigen::AlignedBox3f localBox(const BodyInstance& body);

/// Where the bodies that are no glass show, and a pixel around: the whole picture where one reaches behind the eye.
/// Disjoint.
std::vector<PixelRect> placesInPicture(const BodyScene& bodies, const ViewGeometry& view);

/// Where the floor shows that they keep light from, be it the sun's or the sky's, likewise.
std::vector<PixelRect> shadedFloor(const BodyScene& bodies, const v1::Scene& scene, const ViewGeometry& view);

}  // namespace sluice::render
