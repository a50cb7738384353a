#include "passes.h"

namespace sluice::render {

BlendLiquidPass::BlendLiquidPass() : program_(shaders().program("picture.vert", "blend_liquid.frag")) {}

void BlendLiquidPass::run(const FrameContext& frame) const {
  copy(frame, sceneOf(frame.plan), Resource::Picture);
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bindTexture(frame, 0, Resource::Liquid);
  glUseProgram(program_.name());
  glProgramUniform2f(program_.name(), 0, frame.surfaceView.maxSlope.x(), frame.surfaceView.maxSlope.y());
  drawPicture();
}

}  // namespace sluice::render
