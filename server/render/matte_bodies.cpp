#include "matte_bodies.h"

#include "frame_context.h"
#include "pack.h"

namespace sluice::render {

namespace {

bool isClosed(const v1::Body& body) {
  return body.has_sphere() || (body.has_box() && !body.box().open_top()) ||
         (body.has_cylinder() && !body.cylinder().open_top());
}

}  // namespace

void MatteBodies::draw(const BodyScene& bodies, const ViewGeometry& view, GLenum outside) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glCullFace(GL_BACK);
  glFrontFace(outside);
  glEnable(GL_CLIP_DISTANCE0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  for (const BodyInstance& body : bodies.bodies()) {
    if (body.isGlass()) continue;
    const GLuint program = programOf(body).name();
    glProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, body.pose.matrix().data());
    const v1::Matte& matte = body.body.matte();
    glProgramUniform4fv(program, 1, 1, pack(matte.colour(), matte.roughness()).data());
    glUseProgram(program);
    // Half of a closed surface is seen from within alone.
    if (isClosed(body.body)) glEnable(GL_CULL_FACE);
    body.model->draw(radiusInPicture(outlineOf(body), view));
    glDisable(GL_CULL_FACE);
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
