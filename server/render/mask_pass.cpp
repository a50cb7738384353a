#include "passes.h"

namespace sluice::render {

MaskPass::MaskPass() : program_(shaders().program("picture.vert", "mask.frag")) {}

void MaskPass::run(const FrameContext& frame) {
  const bool bodies = frame.targets.has(Resource::SceneDepth);
  if (bodies && !withBodies_) {
    withBodies_ = shaders().program("picture.vert", "mask.frag", std::array{std::string_view("BODIES")});
  }
  const GLuint surface = frame.targets.texture(Resource::Surface).name();
  frame.targets.clearStencil();
  beginTarget(frame, Resource::Surface);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 0xFF);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glBindTextureUnit(0, surface);
  if (bodies) bindTexture(frame, 7, Resource::SceneDepth);
  glUseProgram(bodies ? withBodies_->name() : program_.name());
  // The surface is read and, with its colour masked off, not written: no feedback.
  drawPicture();
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace sluice::render
