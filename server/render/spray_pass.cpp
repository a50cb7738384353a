#include "passes.h"

namespace sluice::render {

void SprayPass::run(const FrameContext& frame) {
  const bool hasLiquid = frame.plan.runs(Pass::Composite, frame.liquid);
  const bool hasOthers = frame.plan.layers > 1 || (!hasLiquid && frame.plan.runs(Pass::Composite));
  const bool hasBodies = frame.targets.has(Resource::SceneDepth);
  std::vector<std::string_view> defines;
  if (hasLiquid) defines.emplace_back("LIQUID");
  if (hasOthers) defines.emplace_back("LAYERED");
  if (hasBodies) defines.emplace_back("BODIES");
  auto program = programs_.find(defines);
  if (program == programs_.end()) {
    program = programs_.emplace(defines, shaders().program("spray.vert", "spray.frag", defines)).first;
  }
  beginTarget(frame, Resource::Picture);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  // Colours come multiplied by their coverage.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (hasLiquid) bindTexture(frame, 0, Resource::Surface);
  if (hasOthers) bindOtherSurfaces(frame, program->second);
  if (hasBodies) bindTexture(frame, 7, Resource::SceneDepth);
  glUseProgram(program->second.name());
  aimSplats(program->second, frame.view, false);
  frame.splats.spray.drawRectangles();
}

}  // namespace sluice::render
