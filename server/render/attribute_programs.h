#pragma once

#include <cstddef>
#include <span>

#include "attribute_raster.h"
#include "sluice/gl/objects.h"

namespace sluice::render {

/// What brings values of particles to the surface on a device: its programs, and the particles there. The same sums as
/// AttributeRaster's, to float rounding. Lives on the thread of its context.
class AttributePrograms {
 public:
  AttributePrograms();

  /// Adds the particles up in the bound target, seen by `target`, with blending. The surface is at binding 0.
  void sum(std::span<const ViewValue> particles, float radius, const ViewGeometry& surfaceView,
           const ViewGeometry& target);

  /// Makes values of the sums, which are at binding 0.
  const gl::Program& finish() const { return finish_; }

 private:
  gl::Program sum_;
  gl::Program finish_;
  gl::StreamBuffer buffer_;
  gl::VertexArray array_;
};

}  // namespace sluice::render
