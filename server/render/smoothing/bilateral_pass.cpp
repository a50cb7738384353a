#include <cmath>

#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

class BilateralPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const v1::Smoothing& smoothing = frame.look.smoothing();
    const v1::Bilateral& method = smoothing.bilateral();
    // Variances add up: n passes of σ/√n smooth as much as one of σ.
    const double deviation = smoothingDeviation(smoothing, frame.scale.spacing) / std::sqrt(method.iterations());
    const double depthDeviation = method.depth_deviation_in_radii() * frame.scale.radius;
    glProgramUniform1f(program_.name(), 1, static_cast<float>(deviation));
    glProgramUniform1f(program_.name(), 2, static_cast<float>(depthDeviation));
    SurfaceTurns turns(frame);
    for (unsigned i = 0; i < method.iterations(); ++i) turns.drawAlongAxes(program_);
    turns.finish();
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "bilateral.frag");
};

}  // namespace

SmoothingPlan planBilateral(const v1::Smoothing& smoothing, const SurfaceTraits&) {
  return {.scratch = 1, .mask = true, .sweeps = static_cast<int>(2 * smoothing.bilateral().iterations())};
}

std::unique_ptr<SmoothingMethod> makeBilateral() { return std::make_unique<BilateralPass>(); }

}  // namespace sluice::render
