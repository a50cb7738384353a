#include "passes.h"
#include "splat_target.h"

namespace sluice::render {

namespace {

void beginSum(const FrameContext& frame) {
  beginTarget(frame, Resource::Thickness);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
}

}  // namespace

ThicknessPass::ThicknessPass()
    : points_(shaders().program("splats.vert", "thickness.frag")),
      large_(shaders().program("large_splats.vert", "thickness.frag", std::array{std::string_view("LARGE")})) {}

void ThicknessPass::runPoints(const FrameContext& frame) const {
  if (frame.plan.device.software) {
    const float particleVolume = frame.scale.spacing * frame.scale.spacing * frame.scale.spacing;
    frame.raster.drawThickness(frame.selection.spheres, frame.thicknessView, particleVolume,
                               frame.targets.startAnew(Resource::Thickness));
    return;
  }
  frame.targets.clear(Resource::Thickness);
  beginSum(frame);
  glUseProgram(points_.name());
  aimSplats(points_, frame.thicknessView, true);
  frame.splats.drawPoints(frame.selection.spheres.size());
}

void ThicknessPass::runLarge(const FrameContext& frame) const {
  if (!frame.plan.runs(Pass::Thickness)) frame.targets.clear(Resource::Thickness);
  beginSum(frame);
  glUseProgram(large_.name());
  aimSplats(large_, frame.thicknessView, false);
  frame.splats.drawLarge();
}

}  // namespace sluice::render
