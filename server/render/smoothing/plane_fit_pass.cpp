#include <array>
#include <cmath>

#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

/// What each fit takes of the smoothing time. Along the edges of a surface one fit alone still follows the splat at the
/// pixel, through the differences of depth from there, and leaves speckles; those after it start from a surface that is
/// smooth. The last is small: its samples are next to each other, where those of the others may leave out pixels.
constexpr std::array kShares{15.0 / 32, 15.0 / 32, 1.0 / 16};

class PlaneFitPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const v1::Smoothing& smoothing = frame.look.smoothing();
    const double range = smoothing.plane_fit().range_in_radii() * frame.scale.radius;
    glProgramUniform1f(program_.name(), 1, static_cast<float>(range));
    SurfaceTurns turns(frame);
    // On evenly spread pixels the fitted plane's middle is their weighted mean: the same σ smooths as much as a
    // Gaussian, and variances add up.
    const double deviation = smoothingDeviation(smoothing, frame.scale.spacing);
    for (const double share : kShares) {
      glProgramUniform1f(program_.name(), 0, static_cast<float>(deviation * std::sqrt(share)));
      turns.draw(program_);
    }
    turns.finish();
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "plane_fit.frag");
};

}  // namespace

SmoothingPlan planPlaneFit(const v1::Smoothing&, const SurfaceTraits&) {
  return {.scratch = 1, .mask = true, .sweeps = static_cast<int>(kShares.size())};
}

std::unique_ptr<SmoothingMethod> makePlaneFit() { return std::make_unique<PlaneFitPass>(); }

}  // namespace sluice::render
