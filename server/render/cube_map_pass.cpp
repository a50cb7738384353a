#include <array>

#include "body_passes.h"

namespace sluice::render {

void CubeMapPass::run(const FrameContext& frame, const BodyScene& bodies) {
  constexpr std::array<GLfloat, 4> kNothing{};
  const auto edge = static_cast<int>(frame.look.liquid().cube_map().edge());
  frame.cube.begin({frame.mirror.middle, edge, bodies.changes(), frame.scene.background()});
  glDisable(GL_BLEND);
  // Mesa draws into no two pictures as long as the blend function has a second source, be it in use or not.
  glBlendFunc(GL_ONE, GL_ZERO);
  glDisable(GL_STENCIL_TEST);
  glViewport(0, 0, edge, edge);
  for (int face = 0; face < 6; ++face) {
    FrameUniforms uniforms = frame.uniforms;
    const ViewGeometry view = cubeFace(frame.mirror.middle, face, edge);
    aim(uniforms, view);
    uniforms_.upload(std::as_bytes(std::span(&uniforms, 1)));
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_.name());
    const GLuint framebuffer = frame.cube.framebufferOf(face);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    for (const GLint picture : {0, 1}) glClearNamedFramebufferfv(framebuffer, GL_COLOR, picture, kNothing.data());
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, kNothing.data());
    // Faces of a cube are seen mirrored, as from outside.
    matte_.draw(bodies, view, GL_CCW);
  }
}

}  // namespace sluice::render
