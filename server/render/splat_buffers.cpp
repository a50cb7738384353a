#include "splat_buffers.h"

#include <cstddef>

namespace sluice::render {

namespace {

void setAttribute(const gl::VertexArray& array, GLuint attribute, GLint components, std::size_t offset) {
  glEnableVertexArrayAttrib(array.name(), attribute);
  glVertexArrayAttribFormat(array.name(), attribute, components, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(array.name(), attribute, 0);
}

}  // namespace

void SplatArray::upload(std::span<const ViewSphere> spheres) {
  count_ = spheres.size();
  buffer_.upload(std::as_bytes(spheres));
  setAttribute(array_, 0, 4, 0);
  glDisableVertexArrayAttrib(array_.name(), 1);
  glDisableVertexArrayAttrib(array_.name(), 2);
  glVertexArrayVertexBuffer(array_.name(), 0, buffer_.name(), 0, sizeof(ViewSphere));
}

void SplatArray::upload(std::span<const ViewEllipsoid> ellipsoids) {
  count_ = ellipsoids.size();
  buffer_.upload(std::as_bytes(ellipsoids));
  setAttribute(array_, 0, 4, 0);
  setAttribute(array_, 1, 3, offsetof(ViewEllipsoid, xx));
  setAttribute(array_, 2, 3, offsetof(ViewEllipsoid, xy));
  glVertexArrayVertexBuffer(array_.name(), 0, buffer_.name(), 0, sizeof(ViewEllipsoid));
}

void SplatArray::drawPoints() const {
  glVertexArrayBindingDivisor(array_.name(), 0, 0);
  glBindVertexArray(array_.name());
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count_));
}

void SplatArray::drawRectangles() const {
  // One splat for all four vertices.
  glVertexArrayBindingDivisor(array_.name(), 0, 1);
  glBindVertexArray(array_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count_));
}

}  // namespace sluice::render
