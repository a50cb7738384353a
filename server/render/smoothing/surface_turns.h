#pragma once

#include "frame_context.h"

namespace sluice::render {

/// Draws the surface anew, again and again, to and fro between Resource::Surface and kSurfaceScratch[0], where there is
/// liquid alone.
class SurfaceTurns {
 public:
  explicit SurfaceTurns(const FrameContext& frame) : frame_(frame) {}

  /// `program` reads the surface at binding 0, and what it writes is the surface from then on.
  void draw(const gl::Program& program);

  /// The same, first along x, then along y. The program's uniform at location 0 is the step from one pixel to the next,
  /// in texture coordinates.
  void drawAlongAxes(const gl::Program& program);

  /// Puts the result where it belongs.
  void finish();

 private:
  const FrameContext& frame_;
  Resource from_ = Resource::Surface;
  Resource to_ = kSurfaceScratch[0];
};

/// Draws `program`, which reads `from` at binding 0, into `to` where there is liquid.
void drawWhereLiquid(const FrameContext& frame, const gl::Program& program, Resource from, Resource to);

}  // namespace sluice::render
