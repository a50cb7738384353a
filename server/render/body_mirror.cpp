#include "body_mirror.h"

#include <algorithm>
#include <array>
#include <limits>

#include "composite_variant.h"
#include "same.h"

namespace sluice::render {

namespace {

// In shaders/body_mirror.glsl.
constexpr GLuint kLightBinding = 25;
constexpr GLuint kDistanceBinding = 26;

/// Of rays in a cube map.
constexpr int kCubeSteps = 12;

gl::Texture makeCube(GLenum format, int edge) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &name);
  gl::Texture texture(name);
  glTextureStorage2D(name, 1, format, edge, edge);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

/// How far along a ray of unit direction from `point` a body ends; 0 where that is outside.
float wayOut(const Eigen::Vector3f& point, const Eigen::Vector3f& direction, const BodyInstance& body) {
  const Eigen::AlignedBox3f box = localBox(body);
  const Eigen::Vector3f start = body.pose.inverse() * point;
  if (body.isGlass() || !box.contains(start)) return 0;
  const Eigen::Array3f along = (body.pose.linear().transpose() * direction).array();
  const Eigen::Array3f until = (along < 0).select(box.min() - start, box.max() - start).array().abs() / along.abs();
  return until.minCoeff();
}

}  // namespace

Eigen::Vector3f middleOf(const core::ParticleSnapshot& particles, const BodyScene& bodies, const Eigen::Vector3f& eye) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& position : particles.positions) sum += position.cast<double>();
  const double spacing = particles.spacing;
  const auto count = static_cast<double>(std::max<std::size_t>(particles.size(), 1));
  const Eigen::Vector3f middle = (spacing * (sum / (count * spacing)).array().round()).matrix().cast<float>();
  const Eigen::Vector3f towardsEye = (eye - middle).normalized();
  for (const BodyInstance& body : bodies.bodies()) {
    const float out = wayOut(middle, towardsEye, body);
    if (out > 0) return middle + (out + 0.5F * boundsOf(body).radius) * towardsEye;
  }
  return middle;
}

BodyMirror BodyMirror::of(const core::ParticleSnapshot& particles, const v1::Liquid& liquid, const v1::Scene& scene,
                          const BodyScene& bodies, const Eigen::Vector3f& eye) {
  BodyMirror mirror;
  const bool cube = !whyNoCubeMap(liquid, scene);
  if (!cube && !liquid.has_screen_space()) return mirror;
  for (const BodyInstance& body : bodies.bodies()) {
    if (body.isGlass()) continue;
    mirror.reach = std::max(mirror.reach, boundsOf(body).radius);
  }
  mirror.steps = kCubeSteps;
  if (cube) {
    mirror.middle = middleOf(particles, bodies, eye);
  } else {
    mirror.reach = static_cast<float>(liquid.screen_space().body_depth());
    mirror.steps = static_cast<int>(liquid.screen_space().steps());
  }
  return mirror;
}

ViewGeometry cubeFace(const Eigen::Vector3f& middle, int face, int edge) {
  using Eigen::Vector3f;
  struct Axes {
    Vector3f right, down, forward;
  };
  // GL 4.5, table 8.19: s, t and the major axis of each face.
  const std::array<Axes, 6> faces{{{-Vector3f::UnitZ(), -Vector3f::UnitY(), Vector3f::UnitX()},
                                   {Vector3f::UnitZ(), -Vector3f::UnitY(), -Vector3f::UnitX()},
                                   {Vector3f::UnitX(), Vector3f::UnitZ(), Vector3f::UnitY()},
                                   {Vector3f::UnitX(), -Vector3f::UnitZ(), -Vector3f::UnitY()},
                                   {Vector3f::UnitX(), -Vector3f::UnitY(), Vector3f::UnitZ()},
                                   {-Vector3f::UnitX(), -Vector3f::UnitY(), -Vector3f::UnitZ()}}};
  const Axes& axes = faces[static_cast<std::size_t>(face)];
  ViewGeometry view;
  view.eye = middle;
  view.right = axes.right;
  view.down = axes.down;
  view.forward = axes.forward;
  view.maxSlope = {1.0F, 1.0F};
  view.pixelSlope = 2.0F / static_cast<float>(edge);
  view.size = {edge, edge};
  return view;
}

bool BodyCube::shows(const Content& content) const {
  return light_ && content_.middle == content.middle && content_.edge == content.edge &&
         content_.bodyChanges == content.bodyChanges && same(content_.background, content.background);
}

void BodyCube::begin(const Content& content) {
  if (content.edge != content_.edge) {
    const core::ImageSize size{content.edge, content.edge};
    light_ = makeCube(GL_RGBA16F, content.edge);
    distance_ = makeCube(GL_RG32F, content.edge);
    depth_ = gl::makeTexture(GL_DEPTH_COMPONENT32F, size);
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    framebuffer_ = gl::Framebuffer(name);
    constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(name, kBoth.size(), kBoth.data());
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  }
  content_ = content;
}

GLuint BodyCube::framebufferOf(int face) {
  glNamedFramebufferTextureLayer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, light_.name(), 0, face);
  glNamedFramebufferTextureLayer(framebuffer_.name(), GL_COLOR_ATTACHMENT1, distance_.name(), 0, face);
  return framebuffer_.name();
}

void BodyCube::bind() const {
  glBindTextureUnit(kLightBinding, light_.name());
  glBindTextureUnit(kDistanceBinding, distance_.name());
}

}  // namespace sluice::render
