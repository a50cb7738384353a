#include <utility>

#include "passes.h"

namespace sluice::render {

CurvatureFlowPass::CurvatureFlowPass() : program_(shaders().program("picture.vert", "curvature_flow.frag")) {}

void CurvatureFlowPass::run(const FrameContext& frame) const {
  const FlowSchedule& schedule = frame.plan.flow;
  const double edge = frame.look.smoothing().curvature_flow().edge_in_radii() * frame.scale.radius;
  glProgramUniform1f(program_.name(), 0, static_cast<float>(schedule.stepTime));
  glProgramUniform1f(program_.name(), 1, static_cast<float>(edge));
  Resource from = Resource::Surface;
  Resource to = Resource::SurfaceScratch;
  for (int i = 0; i < schedule.iterations; ++i) {
    beginTarget(frame, to);
    keepToLiquid();
    glUseProgram(program_.name());
    glBindTextureUnit(0, frame.targets.texture(from).name());
    drawPicture();
    std::swap(from, to);
  }
}

}  // namespace sluice::render
