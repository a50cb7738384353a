#include "passes.h"

namespace sluice::render {

namespace {

void beginNearest(const FrameContext& frame) {
  beginTarget(frame, Resource::Surface);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
}

void drawNatively(const FrameContext& frame) {
  const SplatList& visible = frame.selection.visible;
  const float rimDepth = frame.surface().flatRims ? kRimDepth : 0.0F;
  const std::span<float> surface = frame.targets.startAnew(Resource::Surface);
  switch (frame.shape) {
    case SplatShape::Sphere:
      frame.raster.drawDepth(visible.spheres, frame.surfaceView, rimDepth, surface);
      break;
    case SplatShape::Ellipsoid:
      frame.raster.drawDepth(visible.ellipsoids, frame.surfaceView, rimDepth, surface);
      break;
    case SplatShape::Disc:
      frame.raster.drawDiscDepth(visible.spheres, frame.surfaceView, surface);
      break;
  }
}

}  // namespace

void SplatsPass::runPoints(const FrameContext& frame) {
  if (frame.plan.device.software) {
    drawNatively(frame);
    return;
  }
  frame.targets.clear(Resource::Surface);
  beginNearest(frame);
  const gl::Program& program = programs_.points(frame.shape);
  glUseProgram(program.name());
  aimSplats(program, frame.surfaceView, true);
  frame.splats.visible.drawPoints();
}

void SplatsPass::runLarge(const FrameContext& frame) {
  if (!frame.plan.runs(Pass::Splats, frame.liquid)) frame.targets.clear(Resource::Surface);
  beginNearest(frame);
  const gl::Program& program = programs_.large(frame.shape);
  glUseProgram(program.name());
  aimSplats(program, frame.surfaceView, false);
  frame.splats.large.drawRectangles();
}

}  // namespace sluice::render
