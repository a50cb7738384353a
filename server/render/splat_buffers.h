#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "sluice/gl/objects.h"
#include "splat_selection.h"

namespace sluice::render {

/// The particles of a frame on the device.
class SplatBuffers {
 public:
  SplatBuffers();

  /// Positions in world space, m.
  void uploadPositions(std::span<const Eigen::Vector3f> positions);

  /// `positions` are those last uploaded.
  void uploadSelection(const SplatSelection& selection, std::span<const Eigen::Vector3f> positions);

  /// Draws the first `count` points of the selection; attribute 0 is the position.
  void drawPoints(std::size_t count) const;
  /// Draws a rectangle of four vertices for every large splat; attribute 0 is the position.
  void drawLarge() const;

  std::size_t points() const { return points_; }
  std::size_t visiblePoints() const { return visiblePoints_; }

 private:
  gl::StreamBuffer positions_;
  gl::StreamBuffer indices_;
  gl::StreamBuffer largePositions_;
  gl::VertexArray pointArray_;
  gl::VertexArray largeArray_;
  std::size_t points_ = 0;
  std::size_t visiblePoints_ = 0;
  std::size_t large_ = 0;
};

}  // namespace sluice::render
