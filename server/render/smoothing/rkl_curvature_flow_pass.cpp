#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "smoothing/curvature_flow_schedule.h"
#include "smoothing/explicit_flow.h"
#include "smoothing/rkl_stages.h"
#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

constexpr Resource kStart = kSurfaceScratch[2];      // Y_0
constexpr Resource kStartRate = kSurfaceScratch[3];  // q_t at Y_0

constexpr std::array<std::string_view, 1> kRate{"RATE"};

class RklCurvatureFlowPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const FlowSchedule& schedule = frame.surface().flow;
    const double edge = frame.look.smoothing().rkl_curvature_flow().edge_in_radii() * frame.scale.radius;
    if (frame.plan.device.software) {
      cpu_.run(frame.targets.change(Resource::Surface), frame.surfaceView.size,
               {frame.surfaceView.pixelSlope, static_cast<float>(edge)}, schedule);
      return;
    }
    glProgramUniform1f(rate_.name(), 1, static_cast<float>(edge));
    glProgramUniform1f(stage_.name(), 1, static_cast<float>(edge));
    const std::vector<RklStage> stages = rklStages(schedule.stages);
    Resource last = Resource::Surface;     // Y_{j−1}
    Resource before = kSurfaceScratch[0];  // Y_{j−2}
    Resource next = kSurfaceScratch[1];    // Y_j
    for (int i = 0; i < schedule.iterations; ++i) {
      copy(frame, last, kStart);
      drawWhereLiquid(frame, rate_, last, kStartRate);
      for (const RklStage& stage : stages) {
        setWeights(stage, schedule.stepTime);
        bindTexture(frame, 1, kStart);
        bindTexture(frame, 2, before);
        bindTexture(frame, 3, kStartRate);
        drawWhereLiquid(frame, stage_, last, next);
        std::swap(before, last);
        std::swap(last, next);
      }
    }
    if (last != Resource::Surface) copy(frame, last, Resource::Surface);
  }

 private:
  void setWeights(const RklStage& stage, double time) const {
    glProgramUniform4f(stage_.name(), 0, static_cast<float>(stage.last), static_cast<float>(stage.before),
                       static_cast<float>(stage.rate * time), static_cast<float>(stage.startRate * time));
  }

  ExplicitFlow cpu_;
  gl::Program rate_ = shaders().program("picture.vert", "rkl_curvature_flow.frag", kRate);
  gl::Program stage_ = shaders().program("picture.vert", "rkl_curvature_flow.frag");
};

}  // namespace

SmoothingPlan planRklCurvatureFlow(const v1::Smoothing& smoothing, const SurfaceTraits& traits) {
  const v1::RklCurvatureFlow& flow = smoothing.rkl_curvature_flow();
  SmoothingPlan plan;
  if (!traits.device.software) plan = {.scratch = kSurfaceScratch.size(), .mask = true};
  plan.flow = scheduleLongSteps(smoothing.time() * traits.spacing * traits.spacing,
                                flow.step_fraction() * largestStableStep(traits), flow.super_steps());
  // The rate at the start of each step counts like a stage.
  plan.sweeps = plan.flow.iterations * (plan.flow.stages + 1);
  reportShortfall(plan.flow, "a step has at most " + std::to_string(kMostRklStages) + " stages", plan);
  return plan;
}

std::unique_ptr<SmoothingMethod> makeRklCurvatureFlow() { return std::make_unique<RklCurvatureFlowPass>(); }

}  // namespace sluice::render
