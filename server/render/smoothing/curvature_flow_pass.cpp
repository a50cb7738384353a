#include "smoothing/curvature_flow_schedule.h"
#include "smoothing/explicit_flow.h"
#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

class CurvatureFlowPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const FlowSchedule& schedule = frame.surface().flow;
    const double edge = frame.look.smoothing().curvature_flow().edge_in_radii() * frame.scale.radius;
    if (frame.plan.device.software) {
      cpu_.run(frame.targets.change(Resource::Surface), frame.surfaceView.size,
               {frame.surfaceView.pixelSlope, static_cast<float>(edge)}, schedule);
      return;
    }
    glProgramUniform1f(program_.name(), 0, static_cast<float>(schedule.stepTime));
    glProgramUniform1f(program_.name(), 1, static_cast<float>(edge));
    SurfaceTurns turns(frame);
    for (int i = 0; i < schedule.iterations; ++i) turns.draw(program_);
    turns.finish();
  }

 private:
  ExplicitFlow cpu_;
  gl::Program program_ = shaders().program("picture.vert", "curvature_flow.frag");
};

}  // namespace

SmoothingPlan planCurvatureFlow(const v1::Smoothing& smoothing, const SurfaceTraits& traits) {
  const v1::CurvatureFlow& flow = smoothing.curvature_flow();
  SmoothingPlan plan;
  if (!traits.device.software) plan = {.scratch = 1, .mask = true};
  plan.flow = scheduleSteps(smoothing.time() * traits.spacing * traits.spacing, largestStableStep(traits),
                            flow.step_fraction(), flow.max_iterations());
  plan.sweeps = plan.flow.iterations;
  reportShortfall(plan.flow, "max_iterations is reached", plan);
  return plan;
}

std::unique_ptr<SmoothingMethod> makeCurvatureFlow() { return std::make_unique<CurvatureFlowPass>(); }

}  // namespace sluice::render
