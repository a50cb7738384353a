#include <cmath>

#include "smoothing/smoothing_method.h"

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
    const core::ImageSize size = frame.surfaceView.size;
    for (unsigned i = 0; i < method.iterations(); ++i) {
      filter(frame, Resource::Surface, Resource::SurfaceScratch, 1.0F / static_cast<float>(size.width), 0.0F);
      filter(frame, Resource::SurfaceScratch, Resource::Surface, 0.0F, 1.0F / static_cast<float>(size.height));
    }
  }

 private:
  void filter(const FrameContext& frame, Resource from, Resource to, float dx, float dy) const {
    beginTarget(frame, to);
    keepToLiquid();
    bindTexture(frame, 0, from);
    glUseProgram(program_.name());
    glProgramUniform2f(program_.name(), 0, dx, dy);
    drawPicture();
  }

  gl::Program program_ = shaders().program("picture.vert", "bilateral.frag");
};

}  // namespace

SmoothingPlan planBilateral(const v1::Smoothing& smoothing, const SurfaceTraits&) {
  return {.scratch = true, .mask = true, .sweeps = static_cast<int>(2 * smoothing.bilateral().iterations())};
}

std::unique_ptr<SmoothingMethod> makeBilateral() { return std::make_unique<BilateralPass>(); }

}  // namespace sluice::render
