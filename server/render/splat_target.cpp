#include "splat_target.h"

#include <algorithm>
#include <array>

namespace sluice::render {

float maxPointPixels() {
  std::array<GLfloat, 2> range{};
  glGetFloatv(GL_POINT_SIZE_RANGE, range.data());
  // Beyond 256 pixels rectangles cost no more, and the viewport's margin stays small.
  return std::min(range[1], 256.0F);
}

void aimSplats(const FrameContext& frame, const gl::Program& program, Resource resource, bool points) {
  const core::ImageSize size = frame.targets.size(resource);
  const float margin = points ? 0.5F * maxPointPixels() + 1.0F : 0.0F;
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  // A smaller target has larger pixels; the picture may be wider than a whole number of them.
  const float pixelSlope = frame.view.pixelSlope * static_cast<float>(frame.view.size.height) / height;
  glViewportIndexedf(0, -margin, -margin, width + 2.0F * margin, height + 2.0F * margin);
  glProgramUniform4f(program.name(), 0, pixelSlope, width, height, margin);
}

}  // namespace sluice::render
