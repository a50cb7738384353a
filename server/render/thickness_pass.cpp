#include "passes.h"

namespace sluice::render {

namespace {

void beginSum(const FrameContext& frame) {
  beginTarget(frame, Resource::Thickness);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
}

/// A disc has no thickness; the sphere around it has that of its particle.
SplatShape solid(SplatShape shape) { return shape == SplatShape::Disc ? SplatShape::Sphere : shape; }

void sumNatively(const FrameContext& frame) {
  const float particleVolume = frame.scale.spacing * frame.scale.spacing * frame.scale.spacing;
  const std::span<float> thickness = frame.targets.startAnew(Resource::Thickness);
  if (frame.shape == SplatShape::Ellipsoid) {
    frame.raster.drawThickness(frame.selection.points.ellipsoids, frame.thicknessView, particleVolume, thickness);
  } else {
    frame.raster.drawThickness(frame.selection.points.spheres, frame.thicknessView, particleVolume, thickness);
  }
}

}  // namespace

void ThicknessPass::runPoints(const FrameContext& frame) {
  if (frame.plan.device.software) {
    sumNatively(frame);
    return;
  }
  frame.targets.clear(Resource::Thickness);
  beginSum(frame);
  const gl::Program& program = programs_.points(solid(frame.shape));
  glUseProgram(program.name());
  aimSplats(program, frame.thicknessView, true);
  frame.splats.points.drawPoints();
}

void ThicknessPass::runLarge(const FrameContext& frame) {
  if (!frame.plan.runs(Pass::Thickness, frame.liquid)) frame.targets.clear(Resource::Thickness);
  beginSum(frame);
  const gl::Program& program = programs_.large(solid(frame.shape));
  glUseProgram(program.name());
  aimSplats(program, frame.thicknessView, false);
  frame.splats.large.drawRectangles();
}

}  // namespace sluice::render
