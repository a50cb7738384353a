#include <array>

#include "passes.h"

namespace sluice::render {

void SunlightPass::run(const FrameContext& frame, const KeptLightMap& light) {
  copy(frame, Resource::Background, Resource::Scene);
  const LightGrid& grid = light.map().grid;
  if (grid.cells() == 0) return;
  if (light.version() != version_) upload(light.map());
  version_ = light.version();
  beginTarget(frame, Resource::Scene);
  bindTexture(frame, 0, Resource::Background);
  glBindTextureUnit(1, texture_.name());
  if (frame.scene.background().floor()) {
    if (!onFloor_) onFloor_ = shaders().program("sunlight.vert", "sunlight.frag");
    glUseProgram(onFloor_->name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  if (frame.plan.buffer(Resource::SceneDepth) != nullptr && !frame.bodyPlaces.empty()) {
    constexpr std::array<std::string_view, 1> kBodies{"BODIES"};
    if (!onBodies_) onBodies_ = shaders().program("picture.vert", "sunlight.frag", kBodies);
    bindTexture(frame, 7, Resource::SceneDepth);
    glUseProgram(onBodies_->name());
    drawPicture(frame.bodyPlaces);
  }
}

void SunlightPass::upload(const LightMap& map) {
  const core::ImageSize size{map.grid.width, map.grid.height};
  if (!texture_ || size != size_) {
    texture_ = gl::makeTexture(GL_RGBA32F, size);
    gl::setBilinear(texture_);
    size_ = size;
  }
  glTextureSubImage2D(texture_.name(), 0, 0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, map.texels.data());
}

}  // namespace sluice::render
