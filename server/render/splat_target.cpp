#include "splat_target.h"

#include <algorithm>
#include <array>
#include <vector>

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

const gl::Program& SplatPrograms::find(SplatShape shape, bool large) {
  const auto found = programs_.find({shape, large});
  if (found != programs_.end()) return found->second;
  std::vector<std::string_view> defines;
  if (large) defines.emplace_back("LARGE");
  if (shape == SplatShape::Ellipsoid) defines.emplace_back("ELLIPSOID");
  if (shape == SplatShape::Disc) defines.emplace_back("DISC");
  const std::string_view vertexShader = large ? "large_splats.vert" : "splats.vert";
  gl::Program program = shaders().program(vertexShader, fragmentShader_, defines);
  return programs_.emplace(std::pair(shape, large), std::move(program)).first->second;
}

}  // namespace sluice::render
