#include "smoothing/surface_turns.h"

#include <utility>

namespace sluice::render {

void drawWhereLiquid(const FrameContext& frame, const gl::Program& program, Resource from, Resource to) {
  beginTarget(frame, to);
  keepToLiquid();
  bindTexture(frame, 0, from);
  glUseProgram(program.name());
  drawPicture();
}

void SurfaceTurns::draw(const gl::Program& program) {
  drawWhereLiquid(frame_, program, from_, to_);
  std::swap(from_, to_);
}

void SurfaceTurns::drawAlongAxes(const gl::Program& program) {
  const core::ImageSize size = frame_.surfaceView.size;
  glProgramUniform2f(program.name(), 0, 1.0F / static_cast<float>(size.width), 0.0F);
  draw(program);
  glProgramUniform2f(program.name(), 0, 0.0F, 1.0F / static_cast<float>(size.height));
  draw(program);
}

void SurfaceTurns::finish() {
  if (from_ == Resource::Surface) return;
  copy(frame_, from_, Resource::Surface);
  std::swap(from_, to_);
}

}  // namespace sluice::render
