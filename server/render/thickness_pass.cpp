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
  beginSum(frame);
  glUseProgram(points_.name());
  aimSplats(frame, points_, Resource::Thickness, true);
  frame.splats.drawPoints(frame.splats.points());
}

void ThicknessPass::runLarge(const FrameContext& frame) const {
  beginSum(frame);
  glUseProgram(large_.name());
  aimSplats(frame, large_, Resource::Thickness, false);
  frame.splats.drawLarge();
}

}  // namespace sluice::render
