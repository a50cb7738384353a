#include <optional>

#include "smoothing/implicit_curvature_flow.h"
#include "smoothing/implicit_flow_shaders.h"
#include "smoothing/smoothing_method.h"

namespace sluice::render {

namespace {

/// On the CPU where that is what draws: elimination along lines is many times as fast there as on software GL.
class ImplicitCurvatureFlowPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const v1::Smoothing& smoothing = frame.look.smoothing();
    const v1::ImplicitCurvatureFlow& method = smoothing.implicit_curvature_flow();
    FlowSettings settings;
    settings.pixelSlope = frame.surfaceView.pixelSlope;
    settings.time = static_cast<float>(smoothing.time() * frame.scale.spacing * frame.scale.spacing);
    settings.edge = static_cast<float>(method.edge_in_radii() * frame.scale.radius);
    settings.spacing = frame.scale.spacing;
    settings.widestGap = static_cast<float>(method.close_gaps_in_spacings() * frame.scale.spacing);
    settings.steps = static_cast<int>(method.steps());
    if (frame.plan.device.software) {
      flow_.smooth(frame.targets.change(Resource::Surface), frame.surfaceView.size, settings);
    } else {
      if (!shaders_) shaders_.emplace();
      shaders_->run(frame, settings);
    }
  }

 private:
  ImplicitCurvatureFlow flow_;
  std::optional<ImplicitFlowShaders> shaders_;
};

}  // namespace

SmoothingPlan planImplicitCurvatureFlow(const v1::Smoothing& smoothing, const SurfaceTraits& traits) {
  // Besides its steps, one to merge splats and the last short one, each along rows and columns.
  const auto sweeps = static_cast<int>(2 * (smoothing.implicit_curvature_flow().steps() + 2));
  const std::size_t scratch = traits.device.software ? 0 : kSurfaceScratch.size();
  return {.scratch = scratch, .flatRims = true, .sweeps = sweeps};
}

std::unique_ptr<SmoothingMethod> makeImplicitCurvatureFlow() { return std::make_unique<ImplicitCurvatureFlowPass>(); }

}  // namespace sluice::render
