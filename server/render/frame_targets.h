#pragma once

#include <map>
#include <span>
#include <vector>

#include "sluice/gl/objects.h"
#include "sluice/render/frame_plan.h"

namespace sluice::render {

/// The picture buffers of a plan: textures that can be drawn into, and, for those of floats, the same picture in memory
/// where a pass works on the CPU. Whichever was written last is copied to the other when that is asked for. Kept while
/// plans ask for the same.
class FrameTargets {
 public:
  /// Makes the buffers exactly those that `plan` needs. Content is kept where a buffer stays as it is.
  void fit(const FramePlan& plan);

  /// Whether the last plan that was fitted has that buffer as a texture.
  bool has(Resource resource) const { return targets_.contains(resource); }
  core::ImageSize size(Resource resource) const;

  /// To read on the device.
  const gl::Texture& texture(Resource resource);
  /// To read or draw on the device.
  GLuint framebuffer(Resource resource);
  /// To draw into all of it on the device; 0 everywhere before.
  void clear(Resource resource);

  /// Row by row from the top. Only for buffers of floats.
  std::span<const float> read(Resource resource);
  std::span<float> change(Resource resource);
  /// All 0.
  std::span<float> startAnew(Resource resource);

  /// The stencil of the surface: no liquid anywhere.
  void clearStencil();

 private:
  enum class Newest { Both, Device, Memory };

  struct Target {
    PictureBuffer buffer;
    gl::Texture texture;
    gl::Framebuffer framebuffer;
    std::vector<float> memory;
    Newest newest = Newest::Device;
  };

  void make(const PictureBuffer& buffer, const PictureBuffer* stencil);
  Target& target(Resource resource);
  static void toDevice(Target& target);
  static void toMemory(Target& target);

  std::vector<PictureBuffer> buffers_;
  std::map<Resource, Target> targets_;
  gl::Renderbuffer stencil_;
};

}  // namespace sluice::render
