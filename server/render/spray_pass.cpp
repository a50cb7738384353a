#include "passes.h"

namespace sluice::render {

void SprayPass::run(const FrameContext& frame) {
  const bool hasLiquid = frame.plan.runs(Pass::Composite, frame.liquid);
  const bool hasOthers = frame.plan.layers > 1 || (!hasLiquid && frame.plan.runs(Pass::Composite));
  auto program = programs_.find({hasLiquid, hasOthers});
  if (program == programs_.end()) {
    std::vector<std::string_view> defines;
    if (hasLiquid) defines.emplace_back("LIQUID");
    if (hasOthers) defines.emplace_back("LAYERED");
    program = programs_.emplace(std::pair(hasLiquid, hasOthers), shaders().program("spray.vert", "spray.frag", defines))
                  .first;
  }
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (hasLiquid) bindTexture(frame, 0, Resource::Surface);
  if (hasOthers) bindOtherSurfaces(frame, program->second);
  glUseProgram(program->second.name());
  aimSplats(program->second, frame.view, false);
  frame.splats.spray.drawRectangles();
}

}  // namespace sluice::render
