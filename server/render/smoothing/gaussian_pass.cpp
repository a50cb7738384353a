#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

class GaussianPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const double deviation = smoothingDeviation(frame.look.smoothing(), frame.scale.spacing);
    glProgramUniform1f(program_.name(), 1, static_cast<float>(deviation));
    SurfaceTurns turns(frame);
    turns.drawAlongAxes(program_);
    turns.finish();
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "gaussian.frag");
};

}  // namespace

SmoothingPlan planGaussian(const v1::Smoothing&, const SurfaceTraits&) {
  return {.scratch = 1, .mask = true, .sweeps = 2};
}

std::unique_ptr<SmoothingMethod> makeGaussian() { return std::make_unique<GaussianPass>(); }

}  // namespace sluice::render
