#pragma once

#include <span>

#include "sluice/gl/objects.h"
#include "splat_raster.h"

namespace sluice::render {

/// Spheres on the device. Attribute 0 is the sphere: centre in view space and radius, m.
class SplatBuffers {
 public:
  SplatBuffers();

  void uploadPoints(std::span<const ViewSphere> spheres);
  void uploadLarge(std::span<const ViewSphere> spheres);

  /// Draws the first `count` points.
  void drawPoints(std::size_t count) const;
  /// Draws a rectangle of four vertices for every large splat.
  void drawLarge() const;

 private:
  gl::StreamBuffer pointSpheres_;
  gl::StreamBuffer largeSpheres_;
  gl::VertexArray pointArray_;
  gl::VertexArray largeArray_;
  std::size_t large_ = 0;
};

}  // namespace sluice::render
