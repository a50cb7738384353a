#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

class FullBilateralPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const v1::Smoothing& smoothing = frame.look.smoothing();
    const double depthDeviation = smoothing.full_bilateral().depth_deviation_in_radii() * frame.scale.radius;
    glProgramUniform1f(program_.name(), 0, static_cast<float>(smoothingDeviation(smoothing, frame.scale.spacing)));
    glProgramUniform1f(program_.name(), 1, static_cast<float>(depthDeviation));
    SurfaceTurns turns(frame);
    turns.draw(program_);
    turns.finish();
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "full_bilateral.frag");
};

}  // namespace

SmoothingPlan planFullBilateral(const v1::Smoothing&, const SurfaceTraits&) { return {.scratch = 1, .mask = true}; }

std::unique_ptr<SmoothingMethod> makeFullBilateral() { return std::make_unique<FullBilateralPass>(); }

}  // namespace sluice::render
