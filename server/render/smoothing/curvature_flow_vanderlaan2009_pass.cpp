#include "smoothing/curvature_flow_schedule.h"
#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

class CurvatureFlowVanDerLaan2009Pass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const double edge = frame.look.smoothing().curvature_flow_vanderlaan2009().edge_in_radii() * frame.scale.radius;
    glProgramUniform1f(program_.name(), 0, static_cast<float>(frame.surface().flow.stepTime));
    glProgramUniform1f(program_.name(), 1, static_cast<float>(edge));
    SurfaceTurns turns(frame);
    for (int i = 0; i < frame.surface().flow.iterations; ++i) turns.draw(program_);
    turns.finish();
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "curvature_flow_vanderlaan2009.frag");
};

}  // namespace

// The printed H counts pixels: it is C·z times the curvature in space (at small slopes), so that a step Δt moves the
// surface like C·z·Δt of flow time. T keeps its meaning at the nearest depth; liquid farther away becomes smoother by
// z/z_min, which is a property of the printed flow. Its largest stable step is C·z_min/2.
SmoothingPlan planCurvatureFlowVanDerLaan2009(const v1::Smoothing& smoothing, const SurfaceTraits& traits) {
  const v1::CurvatureFlowVanDerLaan2009& flow = smoothing.curvature_flow_vanderlaan2009();
  const double footprint = traits.pixelSlope * traits.nearestDepth;
  SmoothingPlan plan{.scratch = 1, .mask = true};
  plan.flow = scheduleSteps(smoothing.time() * traits.spacing * traits.spacing / footprint, footprint / 2,
                            flow.step_fraction(), flow.max_iterations());
  plan.sweeps = plan.flow.iterations;
  reportShortfall(plan.flow, "max_iterations is reached", plan);
  return plan;
}

std::unique_ptr<SmoothingMethod> makeCurvatureFlowVanDerLaan2009() {
  return std::make_unique<CurvatureFlowVanDerLaan2009Pass>();
}

}  // namespace sluice::render
