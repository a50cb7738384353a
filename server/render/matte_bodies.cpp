#include "matte_bodies.h"

#include "frame_context.h"
#include "pack.h"

namespace sluice::render {

void MatteBodies::draw(const BodyScene& bodies) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glEnable(GL_CLIP_DISTANCE0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  for (const BodyInstance& body : bodies.bodies()) {
    if (body.isGlass()) continue;
    const GLuint program = programOf(body).name();
    glProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, body.pose.matrix().data());
    const v1::Matte& matte = body.body.matte();
    glProgramUniform4fv(program, 1, 1, pack(matte.colour(), matte.roughness()).data());
    glUseProgram(program);
    body.model->draw();
  }
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_DEPTH_TEST);
}

const gl::Program& MatteBodies::programOf(const BodyInstance& body) {
  const bool fromPicture = body.body.mesh().has_screen_space_normals();
  auto program = programs_.find(fromPicture);
  if (program == programs_.end()) {
    std::vector<std::string_view> defines = defines_;
    if (fromPicture) defines.emplace_back("SCREEN_SPACE_NORMALS");
    program = programs_.emplace(fromPicture, shaders().program("bodies.vert", "bodies.frag", defines)).first;
  }
  return program->second;
}

}  // namespace sluice::render
