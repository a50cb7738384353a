#include "passes.h"

namespace sluice::render {

GroundShadowPass::GroundShadowPass()
    : clear_(shaders().program("ground_shadow.vert", "ground_shadow.frag")),
      opaque_(shaders().program("ground_shadow.vert", "ground_shadow.frag", std::array{std::string_view("OPAQUE")})),
      texture_(gl::makeTexture(GL_R32F, {ShadowMap::kEdge, ShadowMap::kEdge})) {
  gl::setBilinear(texture_);
}

void GroundShadowPass::run(const FrameContext& frame, const ShadowMap& map, bool isNew) {
  copy(frame, Resource::Background, Resource::Scene);
  if (map.edge <= 0.0F) return;
  if (isNew) {
    glTextureSubImage2D(texture_.name(), 0, 0, 0, ShadowMap::kEdge, ShadowMap::kEdge, GL_RED, GL_FLOAT,
                        map.thickness.data());
  }
  beginTarget(frame, Resource::Scene);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  glBindTextureUnit(0, texture_.name());
  glUseProgram((isOpaque(frame.look.liquid()) ? opaque_ : clear_).name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace sluice::render
