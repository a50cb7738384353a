#include "attribute_programs.h"

#include "frame_context.h"

namespace sluice::render {

AttributePrograms::AttributePrograms()
    : sum_(shaders().program("attributes.vert", "attributes.frag")),
      finish_(shaders().program("picture.vert", "finish_attributes.frag")),
      array_(gl::makeVertexArray()) {
  glEnableVertexArrayAttrib(array_.name(), 0);
  glVertexArrayAttribFormat(array_.name(), 0, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array_.name(), 0, 0);
  // One particle for all four vertices.
  glVertexArrayBindingDivisor(array_.name(), 0, 1);
}

void AttributePrograms::sum(std::span<const ViewValue> particles, float radius, const ViewGeometry& surfaceView,
                            const ViewGeometry& target) {
  const float along = kValueDepthReach * radius;
  glProgramUniform3f(sum_.name(), 0, target.maxSlope.x(), target.maxSlope.y(), target.pixelSlope);
  glProgramUniform3f(sum_.name(), 1, kValueReach * radius, kValueLeastPixels, 1.0F / (along * along));
  glProgramUniform3f(sum_.name(), 2, static_cast<float>(target.size.width), static_cast<float>(target.size.height),
                     target.pixelSlope / surfaceView.pixelSlope);
  buffer_.upload(std::as_bytes(particles));
  glVertexArrayVertexBuffer(array_.name(), 0, buffer_.name(), 0, sizeof(ViewValue));
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
  glUseProgram(sum_.name());
  GLint former = 0;
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &former);
  glBindVertexArray(array_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(particles.size()));
  // What draws the picture goes on with an array of no attributes.
  glBindVertexArray(static_cast<GLuint>(former));
}

}  // namespace sluice::render
