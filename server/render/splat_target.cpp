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

void aimSplats(const gl::Program& program, const ViewGeometry& target, bool points) {
  const float margin = points ? 0.5F * maxPointPixels() + 1.0F : 0.0F;
  const auto width = static_cast<float>(target.size.width);
  const auto height = static_cast<float>(target.size.height);
  glViewportIndexedf(0, -margin, -margin, width + 2.0F * margin, height + 2.0F * margin);
  glProgramUniform4f(program.name(), 0, target.pixelSlope, width, height, margin);
}

}  // namespace sluice::render
