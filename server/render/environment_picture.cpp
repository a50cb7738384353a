#include "environment_picture.h"

#include <algorithm>
#include <bit>

#include "same.h"
#include "sluice/core/input_error.h"

namespace sluice::render {

namespace {

constexpr GLuint kBinding = 24;  // of environmentPicture in shaders/environment.glsl

/// A sky is smooth, but for its horizon and the core of the sun's glow.
constexpr int kSkyEdge = 512;

/// Of a picture that is shown sharp where it fills the view; 2048² texels are 32 MB.
constexpr int kLargestEdge = 2048;

imageio::LinearImage readMap(const v1::Background& background) {
  if (!background.has_environment_map()) return {};
  const std::string& path = background.environment_map().path();
  imageio::LinearImage map = imageio::readImage(path);
  if (map.size.width != 2 * map.size.height) {
    throw core::InputError(path, "background.environment_map.path",
                           "is " + std::to_string(map.size.width) + "x" + std::to_string(map.size.height) +
                               " pixels; allowed are pictures twice as wide as high");
  }
  return map;
}

int edgeFor(const v1::Background& background, const imageio::LinearImage& map) {
  switch (background.environment_case()) {
    case v1::Background::kUniform:
    case v1::Background::kBackdrop:
      return 1;
    case v1::Background::kEnvironmentMap:
      return std::min(static_cast<int>(std::bit_ceil(static_cast<unsigned>(map.size.height))), kLargestEdge);
    default:
      return kSkyEdge;
  }
}

gl::Texture upload(const EnvironmentPicture& picture) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  gl::Texture texture(name);
  glTextureStorage2D(name, 1, GL_RGBA16F, picture.edge, picture.edge);
  glTextureSubImage2D(name, 0, 0, 0, picture.edge, picture.edge, GL_RGBA, GL_FLOAT, picture.values.data());
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

void EnvironmentState::update(const v1::Scene& scene) {
  const v1::Background& background = scene.background();
  const bool sameKind = background.environment_case() == sceneOf_.background().environment_case();
  if (isKnown_ && sameKind && same(sceneOf_.background(), background) &&
      (!background.has_sky() || same(sceneOf_.lighting().sun(), scene.lighting().sun()))) {
    return;
  }
  isKnown_ = false;
  const imageio::LinearImage map = readMap(background);
  const Radiance radiance = radianceOf(scene, map);
  texture_ = upload(makeEnvironmentPicture(radiance, edgeFor(background, map)));
  ambient_ = AmbientLight(radiance);
  *sceneOf_.mutable_background() = background;
  *sceneOf_.mutable_lighting() = scene.lighting();
  isKnown_ = true;
}

void EnvironmentState::bind() const { glBindTextureUnit(kBinding, texture_.name()); }

}  // namespace sluice::render
