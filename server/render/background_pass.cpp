#include "passes.h"

namespace sluice::render {

BackgroundPass::BackgroundPass()
    : sky_(shaders().program("background.vert", "background.frag")),
      floor_(shaders().program("background.vert", "background.frag", std::array{std::string_view("FLOOR")})) {}

void BackgroundPass::run(const FrameContext& frame) const {
  beginTarget(frame, Resource::Background);
  glEnable(GL_CLIP_DISTANCE0);
  glUseProgram(sky_.name());
  drawPicture();
  if (frame.scene.background().floor()) {
    glUseProgram(floor_.name());
    drawPicture();
  }
}

}  // namespace sluice::render
