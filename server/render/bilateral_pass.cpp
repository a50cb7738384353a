#include <cmath>

#include "passes.h"

namespace sluice::render {

BilateralPass::BilateralPass() : program_(shaders().program("picture.vert", "bilateral.frag")) {}

void BilateralPass::run(const FrameContext& frame) const {
  const v1::Smoothing& smoothing = frame.look.smoothing();
  const double deviation = std::sqrt(smoothing.time()) * frame.scale.spacing;
  const double depthDeviation = smoothing.bilateral().depth_deviation_in_radii() * frame.scale.radius;
  glProgramUniform1f(program_.name(), 1, static_cast<float>(deviation));
  glProgramUniform1f(program_.name(), 2, static_cast<float>(depthDeviation));

  const auto filter = [&](Resource from, Resource to, float dx, float dy) {
    beginTarget(frame, to);
    keepToLiquid();
    glBindTextureUnit(0, frame.targets.texture(from).name());
    glUseProgram(program_.name());
    glProgramUniform2f(program_.name(), 0, dx, dy);
    drawPicture();
  };
  filter(Resource::Surface, Resource::SurfaceScratch, 1.0F / static_cast<float>(frame.view.size.width), 0.0F);
  filter(Resource::SurfaceScratch, Resource::Surface, 0.0F, 1.0F / static_cast<float>(frame.view.size.height));
}

}  // namespace sluice::render
