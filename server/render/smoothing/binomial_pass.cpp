#include "smoothing/smoothing_method.h"
#include "smoothing/surface_turns.h"

namespace sluice::render {

namespace {

class BinomialPass final : public SmoothingMethod {
 public:
  void run(const FrameContext& frame) override {
    const v1::Smoothing& smoothing = frame.look.smoothing();
    const core::ImageSize size = frame.surfaceView.size;
    glProgramUniform1f(program_.name(), 1, static_cast<float>(smoothingDeviation(smoothing, frame.scale.spacing)));
    glProgramUniform1i(program_.name(), 3, smoothing.binomial().silhouette_map() ? 1 : 0);
    SurfaceTurns turns(frame);
    glProgramUniform2f(program_.name(), 0, 1.0F / static_cast<float>(size.width), 0.0F);
    glProgramUniform1i(program_.name(), 2, 0);
    turns.draw(program_);
    glProgramUniform2f(program_.name(), 0, 0.0F, 1.0F / static_cast<float>(size.height));
    glProgramUniform1i(program_.name(), 2, 1);
    turns.draw(program_);
    turns.finish();
  }

 private:
  gl::Program program_ = shaders().program("picture.vert", "binomial.frag");
};

}  // namespace

SmoothingPlan planBinomial(const v1::Smoothing& smoothing, const SurfaceTraits&) {
  return {.scratch = 1, .mask = true, .erodes = smoothing.binomial().silhouette_map(), .sweeps = 2};
}

std::unique_ptr<SmoothingMethod> makeBinomial() { return std::make_unique<BinomialPass>(); }

}  // namespace sluice::render
