#include <cmath>

#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

/// Along the edges of a surface one fit alone still follows the splat at the pixel, through the differences of depth
/// from there, and leaves speckles; the third starts from a surface that is smooth.
constexpr int kFits = 3;

class PlaneFitPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const v1::Smoothing& smoothing = frame.look.smoothing();
    const double range = smoothing.plane_fit().range_in_radii() * frame.scale.radius;
    // On evenly spread pixels the fitted plane's middle is their weighted mean: the same σ smooths as much as a
    // Gaussian, and variances add up.
    const double deviation = smoothingDeviation(smoothing, frame.scale.spacing) / std::sqrt(kFits);
    glProgramUniform1f(program_.name(), 0, static_cast<float>(deviation));
    glProgramUniform1f(program_.name(), 1, static_cast<float>(range));
    SurfaceTurns turns(frame);
    for (int i = 0; i < kFits; ++i) turns.draw(program_);
    turns.finish();
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "plane_fit.frag");
};

}  // namespace

SmoothingPlan planPlaneFit(const v1::Smoothing&, const SurfaceTraits&) {
  return {.scratch = 1, .mask = true, .sweeps = kFits};
}

std::unique_ptr<SmoothingMethod> makePlaneFit() { return std::make_unique<PlaneFitPass>(); }

}  // namespace sluice::render
