#include "passes.h"

namespace sluice::render {

BlendLiquidPass::BlendLiquidPass() : program_(shaders().program("picture.vert", "blend_liquid.frag")) {}

void BlendLiquidPass::run(const FrameContext& frame) const {
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Liquid);
  glUseProgram(program_.name());
  drawPicture();
}

}  // namespace sluice::render
