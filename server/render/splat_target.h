#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "frame_context.h"

namespace sluice::render {

/// Sets the viewport and the uniform `target` of splat_shape.glsl for splats into a buffer of this view. Points are
/// drawn in a viewport that reaches beyond it, because GL drops a point whose centre is outside, with all that it
/// covers inside.
void aimSplats(const gl::Program& program, const ViewGeometry& target, bool points);

/// The largest point that splats use, pixels: what the device draws.
float maxPointPixels();

/// The programs that draw splats with one fragment shader, by shape; each is made when it is first used.
class SplatPrograms {
 public:
  explicit SplatPrograms(std::string_view fragmentShader) : fragmentShader_(fragmentShader) {}

  const gl::Program& points(SplatShape shape) { return find(shape, false); }
  const gl::Program& large(SplatShape shape) { return find(shape, true); }

 private:
  const gl::Program& find(SplatShape shape, bool large);

  std::string fragmentShader_;
  std::map<std::pair<SplatShape, bool>, gl::Program> programs_;
};

}  // namespace sluice::render
