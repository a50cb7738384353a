#include "passes.h"

namespace sluice::render {

SunlightPass::SunlightPass() : program_(shaders().program("sunlight.vert", "sunlight.frag")) {}

void SunlightPass::run(const FrameContext& frame, const KeptLightMap& light) {
  copy(frame, Resource::Background, Resource::Scene);
  const LightGrid& grid = light.map().grid;
  if (grid.cells() == 0) return;
  if (light.version() != version_) upload(light.map());
  version_ = light.version();
  beginTarget(frame, Resource::Scene);
  bindTexture(frame, 0, Resource::Background);
  glBindTextureUnit(1, texture_.name());
  glUseProgram(program_.name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
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
