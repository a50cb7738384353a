#include "passes.h"

namespace sluice::render {

void ImplicitCurvatureFlowPass::run(const FrameContext& frame) {
  const v1::Smoothing& smoothing = frame.look.smoothing();
  const v1::ImplicitCurvatureFlow& method = smoothing.implicit_curvature_flow();
  FlowSettings settings;
  settings.pixelSlope = frame.view.pixelSlope;
  settings.time = static_cast<float>(smoothing.time() * frame.scale.spacing * frame.scale.spacing);
  settings.edge = static_cast<float>(method.edge_in_radii() * frame.scale.radius);
  settings.steps = static_cast<int>(method.steps());

  const core::ImageSize size = frame.view.size;
  inverseDepth_.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame.targets.framebuffer(Resource::Surface));
  glReadPixels(0, 0, size.width, size.height, GL_RED, GL_FLOAT, inverseDepth_.data());
  flow_.smooth(inverseDepth_, size, settings);
  glTextureSubImage2D(frame.targets.texture(Resource::Surface).name(), 0, 0, 0, size.width, size.height, GL_RED,
                      GL_FLOAT, inverseDepth_.data());
}

}  // namespace sluice::render
