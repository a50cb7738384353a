#include <array>

#include "body_passes.h"

namespace sluice::render {

void ClipThicknessPass::run(const FrameContext& frame) {
  if (!program_) {
    program_ = shaders().program("picture.vert", "clip_thickness.frag", std::array{std::string_view("LIQUID")});
  }
  beginTarget(frame, Resource::Thickness);
  glUseProgram(program_->name());
  bindTexture(frame, 0, Resource::Surface);
  bindTexture(frame, 7, Resource::SceneDepth);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MIN);
  drawPicture();
  glBlendEquation(GL_FUNC_ADD);
}

}  // namespace sluice::render
