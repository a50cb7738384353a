#pragma once

#include <cstddef>
#include <span>

#include "sluice/gl/objects.h"
#include "view_splats.h"

namespace sluice::render {

/// Splats of one kind on the device. Attribute 0 is a sphere: centre in view space and radius, m; or, of an ellipsoid,
/// the centre and the shortest half axis, with attributes 1 and 2 for S, m²: the diagonal, and xy, xz, yz.
class SplatArray {
 public:
  SplatArray() : array_(gl::makeVertexArray()) {}

  void upload(std::span<const ViewSphere> spheres);
  void upload(std::span<const ViewEllipsoid> ellipsoids);

  /// Draws each as a point.
  void drawPoints() const;
  /// Draws a rectangle of four vertices for each.
  void drawRectangles() const;

 private:
  gl::StreamBuffer buffer_;
  gl::VertexArray array_;
  std::size_t count_ = 0;
};

/// What a frame draws.
struct SplatBuffers {
  SplatArray points;
  SplatArray visible;
  SplatArray large;
  SplatArray spray;
};

}  // namespace sluice::render
