#include "passes.h"
#include "splat_target.h"

namespace sluice::render {

SplatsPass::SplatsPass()
    : points_(shaders().program("splats.vert", "splats.frag")),
      large_(shaders().program("large_splats.vert", "splats.frag", std::array{std::string_view("LARGE")})) {}

void SplatsPass::runPoints(const FrameContext& frame) const {
  beginTarget(frame, Resource::Surface);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  glUseProgram(points_.name());
  aimSplats(frame, points_, Resource::Surface, true);
  frame.splats.drawPoints(frame.splats.visiblePoints());
}

void SplatsPass::runLarge(const FrameContext& frame) const {
  beginTarget(frame, Resource::Surface);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  glUseProgram(large_.name());
  aimSplats(frame, large_, Resource::Surface, false);
  frame.splats.drawLarge();
}

}  // namespace sluice::render
