#include "passes.h"

namespace sluice::render {

namespace {

void drawNatively(const FrameContext& frame, std::span<float> depth) {
  // Of all points, for those that are hidden may well be the last that a line of sight leaves.
  const SplatList& points = frame.selection.points;
  const float rimDepth = frame.surface().flatRims ? kRimDepth : 0.0F;
  switch (frame.shape) {
    case SplatShape::Sphere:
      return frame.raster.drawBackDepth(points.spheres, frame.surfaceView, rimDepth, depth);
    case SplatShape::Ellipsoid:
      return frame.raster.drawBackDepth(points.ellipsoids, frame.surfaceView, rimDepth, depth);
    case SplatShape::Disc:
      return frame.raster.drawDiscBackDepth(points.spheres, frame.surfaceView, depth);
  }
}

}  // namespace

void BackSplatsPass::run(const FrameContext& frame) {
  const bool native = frame.plan.device.software;
  const bool coarse = frame.plan.buffer(Resource::BackCoarse, frame.liquid) != nullptr;
  const Resource depth = !native ? Resource::BackDepth : coarse ? Resource::BackCoarse : Resource::BackSurface;
  if (native) {
    drawNatively(frame, frame.targets.startAnew(depth));
  } else {
    frame.targets.clear(depth);
    if (frame.plan.runs(Pass::Thickness, frame.liquid)) draw(frame, depth, false);
  }
  if (frame.plan.runs(Pass::LargeSplats, frame.liquid)) draw(frame, depth, true);
  if (native) {
    for (float& z : frame.targets.change(depth)) z = z > 0.0F ? 1.0F / z : 0.0F;
    return;
  }
  if (!invert_) invert_ = shaders().program("picture.vert", "invert_depth.frag");
  beginTarget(frame, Resource::BackSurface);
  bindTexture(frame, 0, depth);
  glUseProgram(invert_->name());
  drawPicture();
}

void BackSplatsPass::draw(const FrameContext& frame, Resource depth, bool large) {
  beginTarget(frame, depth);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  const gl::Program& program = large ? programs_.large(frame.shape) : programs_.points(frame.shape);
  glUseProgram(program.name());
  aimSplats(program, frame.surfaceView, !large);
  large ? frame.splats.large.drawRectangles() : frame.splats.points.drawPoints();
}

}  // namespace sluice::render
