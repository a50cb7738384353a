#include <utility>

#include "smoothing/curvature_flow_schedule.h"
#include "smoothing/smoothing_method.h"

namespace sluice::render {

namespace {

class CurvatureFlowPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
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
      bindTexture(frame, 0, from);
      drawPicture();
      std::swap(from, to);
    }
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "curvature_flow.frag");
};

}  // namespace

SmoothingPlan planCurvatureFlow(const v1::Smoothing& smoothing, const SurfaceTraits& traits) {
  const v1::CurvatureFlow& flow = smoothing.curvature_flow();
  SmoothingPlan plan{.scratch = true, .mask = true};
  plan.flow = scheduleSteps(smoothing.time() * traits.spacing * traits.spacing, largestStableStep(traits),
                            flow.step_fraction(), flow.max_iterations());
  plan.sweeps = plan.flow.iterations;
  reportShortfall(plan.flow, plan);
  return plan;
}

std::unique_ptr<SmoothingMethod> makeCurvatureFlow() { return std::make_unique<CurvatureFlowPass>(); }

}  // namespace sluice::render
