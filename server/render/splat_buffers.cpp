#include "splat_buffers.h"

#include <vector>

namespace sluice::render {

namespace {

void setPositionAttribute(const gl::VertexArray& array, const gl::StreamBuffer& buffer) {
  glEnableVertexArrayAttrib(array.name(), 0);
  glVertexArrayAttribFormat(array.name(), 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array.name(), 0, 0);
  glVertexArrayVertexBuffer(array.name(), 0, buffer.name(), 0, sizeof(Eigen::Vector3f));
}

}  // namespace

SplatBuffers::SplatBuffers() : pointArray_(gl::makeVertexArray()), largeArray_(gl::makeVertexArray()) {}

void SplatBuffers::uploadPositions(std::span<const Eigen::Vector3f> positions) {
  positions_.upload(std::as_bytes(positions));
}

void SplatBuffers::uploadSelection(const SplatSelection& selection, std::span<const Eigen::Vector3f> positions) {
  points_ = selection.points.size();
  visiblePoints_ = selection.visiblePoints;
  large_ = selection.large.size();
  indices_.upload(std::as_bytes(std::span(selection.points)));
  setPositionAttribute(pointArray_, positions_);
  glVertexArrayElementBuffer(pointArray_.name(), indices_.name());

  std::vector<Eigen::Vector3f> large;
  large.reserve(large_);
  for (const std::uint32_t index : selection.large) large.push_back(positions[index]);
  largePositions_.upload(std::as_bytes(std::span(large)));
  setPositionAttribute(largeArray_, largePositions_);
  glVertexArrayBindingDivisor(largeArray_.name(), 0, 1);
}

void SplatBuffers::drawPoints(std::size_t count) const {
  glBindVertexArray(pointArray_.name());
  glDrawElements(GL_POINTS, static_cast<GLsizei>(count), GL_UNSIGNED_INT, nullptr);
}

void SplatBuffers::drawLarge() const {
  glBindVertexArray(largeArray_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(large_));
}

}  // namespace sluice::render
