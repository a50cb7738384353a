#include "splat_buffers.h"

namespace sluice::render {

namespace {

void setSphereAttribute(const gl::VertexArray& array, const gl::StreamBuffer& buffer) {
  glEnableVertexArrayAttrib(array.name(), 0);
  glVertexArrayAttribFormat(array.name(), 0, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array.name(), 0, 0);
  glVertexArrayVertexBuffer(array.name(), 0, buffer.name(), 0, sizeof(ViewSphere));
}

}  // namespace

SplatBuffers::SplatBuffers() : pointArray_(gl::makeVertexArray()), largeArray_(gl::makeVertexArray()) {
  glVertexArrayBindingDivisor(largeArray_.name(), 0, 1);
}

void SplatBuffers::uploadPoints(std::span<const ViewSphere> spheres) {
  pointSpheres_.upload(std::as_bytes(spheres));
  setSphereAttribute(pointArray_, pointSpheres_);
}

void SplatBuffers::uploadLarge(std::span<const ViewSphere> spheres) {
  large_ = spheres.size();
  largeSpheres_.upload(std::as_bytes(spheres));
  setSphereAttribute(largeArray_, largeSpheres_);
}

void SplatBuffers::drawPoints(std::size_t count) const {
  glBindVertexArray(pointArray_.name());
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count));
}

void SplatBuffers::drawLarge() const {
  glBindVertexArray(largeArray_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(large_));
}

}  // namespace sluice::render
