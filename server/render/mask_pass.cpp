#include "passes.h"

namespace sluice::render {

MaskPass::MaskPass() : program_(shaders().program("picture.vert", "mask.frag")) {}

void MaskPass::run(const FrameContext& frame) {
  const GLuint surface = frame.targets.texture(Resource::Surface).name();
  frame.targets.clearStencil();
  beginTarget(frame, Resource::Surface);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 0xFF);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glBindTextureUnit(0, surface);
  glUseProgram(program_.name());
  // The surface is read and, with its colour masked off, not written: no feedback.
  drawPicture();
  if (frame.targets.has(Resource::SceneDepth) && !frame.bodyPlaces.empty()) takeOutHidden(frame);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void MaskPass::takeOutHidden(const FrameContext& frame) {
  if (!hidden_) hidden_ = shaders().program("picture.vert", "mask.frag", std::array{std::string_view("BODIES")});
  // The surface may be coarser than the picture.
  const int divisor = static_cast<int>(frame.look.smoothing().divisor());
  std::vector<PixelRect> places;
  for (const PixelRect& rect : frame.bodyPlaces) {
    places.push_back({rect.left / divisor, rect.top / divisor, rect.width / divisor + 2, rect.height / divisor + 2});
  }
  bindTexture(frame, 7, Resource::SceneDepth);
  glStencilFunc(GL_ALWAYS, 0, 0xFF);
  glUseProgram(hidden_->name());
  drawPicture(places);
}

}  // namespace sluice::render
