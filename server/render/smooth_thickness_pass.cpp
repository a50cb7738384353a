#include "passes.h"

namespace sluice::render {

SmoothThicknessPass::SmoothThicknessPass() : program_(shaders().program("picture.vert", "smooth_thickness.frag")) {}

void SmoothThicknessPass::run(const FrameContext& frame) {
  const auto deviation = static_cast<float>(frame.look.thickness().smoothing_in_spacings() * frame.scale.spacing);
  if (frame.plan.device.software) {
    cpu_.smooth(frame.targets.change(Resource::Thickness), frame.thicknessView, frame.targets.read(Resource::Surface),
                frame.surfaceView, deviation);
    return;
  }
  const float scale = ThicknessSmoothing::kReachOfDeviation * deviation / frame.thicknessView.pixelSlope;
  glProgramUniform1f(program_.name(), 1, scale);
  const core::ImageSize size = frame.thicknessView.size;
  const auto smooth = [&](Resource from, Resource to, float dx, float dy) {
    beginTarget(frame, to);
    bindTexture(frame, 0, Resource::Surface);
    bindTexture(frame, 1, from);
    glUseProgram(program_.name());
    glProgramUniform2f(program_.name(), 0, dx, dy);
    drawPicture();
  };
  smooth(Resource::Thickness, Resource::ThicknessScratch, 1.0F / static_cast<float>(size.width), 0.0F);
  smooth(Resource::ThicknessScratch, Resource::Thickness, 0.0F, 1.0F / static_cast<float>(size.height));
}

}  // namespace sluice::render
