#include "body_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frame_uniforms.h"
#include "picture_cover.h"
#include "same.h"
#include "sluice/scene/convert.h"

namespace sluice::render {

namespace {

bool samePoses(std::span<const core::BodyPose> a, std::span<const core::BodyPose> b) {
  return std::ranges::equal(a, b, [](const core::BodyPose& x, const core::BodyPose& y) {
    return x.position == y.position && x.rotation.coeffs() == y.rotation.coeffs();
  });
}

BodyMesh makeShape(const v1::Body& body) {
  switch (body.shape_case()) {
    case v1::Body::kSphere:
      return makeSphere(body.sphere());
    case v1::Body::kCylinder:
      return makeCylinder(body.cylinder());
    case v1::Body::kMesh:
      return makeMesh(particleio::readMeshFile(body.mesh().path()), static_cast<float>(body.mesh().scale()));
    default:
      return makeBox(body.box());
  }
}

/// What tells shapes apart.
std::string keyOf(const v1::Body& body) {
  v1::Body shape;
  if (body.has_sphere()) *shape.mutable_sphere() = body.sphere();
  if (body.has_cylinder()) *shape.mutable_cylinder() = body.cylinder();
  if (body.has_box()) *shape.mutable_box() = body.box();
  if (body.has_mesh()) {
    shape.mutable_mesh()->set_path(body.mesh().path());
    shape.mutable_mesh()->set_scale(body.mesh().scale());
  }
  return shape.SerializeAsString();
}

}  // namespace

BodyTriangles::BodyTriangles(const BodyMesh& mesh)
    : array(gl::makeVertexArray()), indexCount(static_cast<GLsizei>(3 * mesh.triangles.size())) {
  const auto store = [](const auto& elements) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    gl::Buffer buffer(name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(std::as_bytes(std::span(elements)).size()), elements.data(), 0);
    return buffer;
  };
  vertices = store(mesh.vertices);
  indices = store(mesh.triangles);
  glVertexArrayVertexBuffer(array.name(), 0, vertices.name(), 0, sizeof(BodyVertex));
  glVertexArrayElementBuffer(array.name(), indices.name());
  for (const GLuint attribute : {0U, 1U}) {
    glEnableVertexArrayAttrib(array.name(), attribute);
    glVertexArrayAttribFormat(array.name(), attribute, 3, GL_FLOAT, GL_FALSE,
                              attribute * static_cast<GLuint>(sizeof(Eigen::Vector3f)));
    glVertexArrayAttribBinding(array.name(), attribute, 0);
  }
}

BodyModel::BodyModel(const v1::Body& body) : mesh(makeShape(body)) {
  if (!body.has_sphere()) {
    levels.emplace_back(mesh);
    return;
  }
  for (const int facets : kFacetsAround) levels.emplace_back(makeSphere(body.sphere(), facets));
}

void BodyModel::draw(float radiusInPixels) const {
  std::size_t level = 0;
  while (level + 1 < levels.size() && radiusInPixels > largestRadius(kFacetsAround[level])) ++level;
  const BodyTriangles& triangles = levels[level];
  glBindVertexArray(triangles.array.name());
  glDrawElements(GL_TRIANGLES, triangles.indexCount, GL_UNSIGNED_INT, nullptr);
}

void BodyScene::update(const v1::Scene& scene, std::span<const core::BodyPose> poses) {
  const bool unchanged = std::ranges::equal(scene_.bodies(), scene.bodies(), same<v1::Body>) &&
                         same(scene_.lighting(), scene.lighting()) && samePoses(poses_, poses);
  if (unchanged && changes_ > 0) return;
  std::vector<BodyInstance> bodies;
  for (int i = 0; i < scene.bodies_size(); ++i) {
    const v1::Body& body = scene.bodies(i);
    const auto k = static_cast<std::size_t>(i);
    bodies.push_back({modelOf(body), k < poses.size() ? poseOf(poses[k]) : scene::toPose(body), body});
  }
  bodies_ = std::move(bodies);
  std::erase_if(models_, [](const auto& entry) { return entry.second.use_count() == 1; });
  *scene_.mutable_bodies() = scene.bodies();
  *scene_.mutable_lighting() = scene.lighting();
  poses_.assign(poses.begin(), poses.end());
  ++changes_;
}

std::shared_ptr<const BodyModel> BodyScene::modelOf(const v1::Body& body) {
  std::shared_ptr<const BodyModel>& model = models_[keyOf(body)];
  if (model == nullptr) model = std::make_shared<const BodyModel>(body);
  return model;
}

Eigen::AlignedBox3f localBox(const BodyInstance& body) {
  Eigen::AlignedBox3f box;
  for (const BodyVertex& vertex : body.model->mesh.vertices) box.extend(vertex.position);
  return box;
}

float radiusInPicture(const BodyScene::Ball& ball, const ViewGeometry& view) {
  const float beside = (ball.centre - view.eye).squaredNorm() - ball.radius * ball.radius;
  return beside > 0 ? ball.radius / (std::sqrt(beside) * view.pixelSlope) : std::numeric_limits<float>::infinity();
}

BodyScene::Ball boundsOf(const BodyInstance& body) {
  const Eigen::AlignedBox3f box = localBox(body);
  return {body.pose * box.center().eval(), 0.5F * box.sizes().norm()};
}

BodyScene::Ball outlineOf(const BodyInstance& body) {
  BodyScene::Ball ball = boundsOf(body);
  if (body.body.has_sphere()) ball.radius = static_cast<float>(body.body.sphere().radius());
  return ball;
}

namespace {

/// Radii of the ball around a body beyond which it hides no sky, see body_shadow.glsl: five of contacts' radii.
constexpr float kReachOfContact = 5.0F * kContactRadius;

}  // namespace

std::vector<PixelRect> placesInPicture(const BodyScene& bodies, const ViewGeometry& view) {
  std::vector<PixelRect> places;
  for (const BodyInstance& body : bodies.bodies()) {
    if (body.isGlass()) continue;
    PictureCover cover(view);
    cover.add(localBox(body), body.pose);
    places.push_back(cover.pixels());
  }
  return disjoint(std::move(places));
}

std::vector<PixelRect> shadedFloor(const BodyScene& bodies, const v1::Scene& scene, const ViewGeometry& view) {
  const Eigen::Vector3f sun = sunDirection(scene.lighting().sun());
  const auto floor = static_cast<float>(scene.background().floor_height());
  // Shadows of a sun that is hardly above the horizon are longer than any floor that is seen.
  constexpr float kLeastRise = 0.05F;
  if (sun.y() < kLeastRise && bodies.matteBounds().radius > 0) return {{0, 0, view.size.width, view.size.height}};
  std::vector<PixelRect> places;
  for (const BodyInstance& body : bodies.bodies()) {
    if (body.isGlass()) continue;
    PictureCover cover(view);
    const auto addSquare = [&](const Eigen::Vector3f& middle, float half) {
      for (const float x : {-half, half}) {
        for (const float z : {-half, half}) cover.add({middle.x() + x, floor, middle.z() + z});
      }
    };
    const BodyScene::Ball ball = boundsOf(body);
    addSquare(ball.centre, kReachOfContact * ball.radius);
    addSquare(ball.centre - sun * ((ball.centre.y() - floor) / sun.y()), 1.1F * ball.radius / sun.y());
    places.push_back(cover.pixels());
  }
  return disjoint(std::move(places));
}

BodyScene::Ball BodyScene::matteBounds() const {
  Eigen::AlignedBox3f box;
  for (const BodyInstance& body : bodies_) {
    if (body.isGlass()) continue;
    const Ball ball = boundsOf(body);
    box.extend((ball.centre.array() - ball.radius).matrix());
    box.extend((ball.centre.array() + ball.radius).matrix());
  }
  return box.isEmpty() ? Ball{} : Ball{box.center(), 0.5F * box.sizes().norm()};
}

}  // namespace sluice::render
