#include "passes.h"

namespace sluice::render {

void SprayPass::run(const FrameContext& frame) {
  const bool hasLiquid = frame.plan.runs(Pass::Composite);
  if (!hasLiquid) copy(frame, sceneOf(frame.plan), Resource::Picture);
  if (view_ != View::Liquid) return;  // drops are no part of the surface
  std::optional<gl::Program>& program = hasLiquid ? overLiquid_ : alone_;
  if (!program) {
    std::vector<std::string_view> defines;
    if (hasLiquid) defines.emplace_back("LIQUID");
    program = shaders().program("spray.vert", "spray.frag", defines);
  }
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (hasLiquid) bindTexture(frame, 0, Resource::Surface);
  glUseProgram(program->name());
  aimSplats(*program, frame.view, false);
  glProgramUniform2f(program->name(), 1, frame.surfaceView.maxSlope.x(), frame.surfaceView.maxSlope.y());
  frame.splats.spray.drawRectangles();
}

}  // namespace sluice::render
