#pragma once

#include <map>
#include <vector>

#include "sluice/gl/objects.h"
#include "sluice/render/frame_plan.h"

namespace sluice::render {

/// The picture buffers of a plan as textures that can be drawn into. Kept while plans ask for the same.
class FrameTargets {
 public:
  /// Makes the buffers exactly those that `plan` needs. Content is kept where a buffer stays as it is.
  void fit(const FramePlan& plan);

  /// Whether the last plan that was fitted has that buffer as a texture.
  bool has(Resource resource) const { return targets_.contains(resource); }

  const gl::Texture& texture(Resource resource) const { return target(resource).texture; }
  GLuint framebuffer(Resource resource) const { return target(resource).framebuffer.name(); }
  core::ImageSize size(Resource resource) const { return target(resource).buffer.size; }

 private:
  struct Target {
    PictureBuffer buffer;
    gl::Texture texture;
    gl::Framebuffer framebuffer;
  };

  const Target& target(Resource resource) const;

  std::vector<PictureBuffer> buffers_;
  std::map<Resource, Target> targets_;
  gl::Renderbuffer stencil_;
};

}  // namespace sluice::render
