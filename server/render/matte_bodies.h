#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "body_scene.h"
#include "sluice/gl/shader_library.h"

namespace sluice::render {

/// Draws the bodies that are no glass into whatever framebuffer is bound, whose depth is 0 at infinity. Lives on the
/// thread of the context.
class MatteBodies {
 public:
  /// `defines` of bodies.vert and bodies.frag.
  explicit MatteBodies(std::vector<std::string_view> defines = {}) : defines_(std::move(defines)) {}

  /// `outside` is how the outer sides of triangles turn in the picture: GL_CW where view space has y down.
  void draw(const BodyScene& bodies, const ViewGeometry& view, GLenum outside = GL_CW);

 private:
  const gl::Program& programOf(const BodyInstance& body);

  std::vector<std::string_view> defines_;
  std::map<bool, gl::Program> programs_;  ///< By whether normals come from the picture.
};

}  // namespace sluice::render
