#include "passes.h"
#include "splat_target.h"

namespace sluice::render {

SplatsPass::SplatsPass()
    : points_(shaders().program("splats.vert", "splats.frag")),
      large_(shaders().program("large_splats.vert", "splats.frag", std::array{std::string_view("LARGE")})) {}

void SplatsPass::runPoints(const FrameContext& frame) const {
  const std::size_t visible = frame.selection.visiblePoints;
  if (frame.plan.device.software) {
    frame.raster.drawDepth(std::span(frame.selection.spheres).first(visible), frame.surfaceView,
                           frame.plan.flatRims ? kRimDepth : 0.0F, frame.targets.startAnew(Resource::Surface));
    return;
  }
  frame.targets.clear(Resource::Surface);
  beginTarget(frame, Resource::Surface);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  glUseProgram(points_.name());
  aimSplats(points_, frame.surfaceView, true);
  frame.splats.drawPoints(visible);
}

void SplatsPass::runLarge(const FrameContext& frame) const {
  if (!frame.plan.runs(Pass::Splats)) frame.targets.clear(Resource::Surface);
  beginTarget(frame, Resource::Surface);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  glUseProgram(large_.name());
  aimSplats(large_, frame.surfaceView, false);
  frame.splats.drawLarge();
}

}  // namespace sluice::render
