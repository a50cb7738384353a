#include <array>

#include "body_passes.h"

namespace sluice::render {

void BodyShadowPass::run(const FrameContext& frame, const BodyScene& bodies) {
  if (!program_) {
    program_ = shaders().program("bodies.vert", "bodies.frag", std::array{std::string_view("SHADOW")});
    map_ = gl::makeTexture(GL_DEPTH_COMPONENT24, {kBodyShadowEdge, kBodyShadowEdge});
    gl::setBilinear(map_);
    glTextureParameteri(map_.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(map_.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    framebuffer_ = gl::Framebuffer(name);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, map_.name(), 0);
    glNamedFramebufferDrawBuffer(name, GL_NONE);
    glNamedFramebufferReadBuffer(name, GL_NONE);
  }
  beginTarget(frame, Resource::Background);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, kBodyShadowEdge, kBodyShadowEdge);
  constexpr GLfloat kFarthest = 1;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &kFarthest);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glUseProgram(program_->name());
  for (const BodyInstance& body : bodies.bodies()) {
    if (body.isGlass()) continue;
    glProgramUniformMatrix4fv(program_->name(), 0, 1, GL_FALSE, body.pose.matrix().data());
    body.model->draw(kBodyShadowEdge * outlineOf(body).radius / bodies.matteBounds().radius);
  }
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glDisable(GL_DEPTH_TEST);
}

void BodyShadowPass::bind() const { glBindTextureUnit(15, map_.name()); }

}  // namespace sluice::render
