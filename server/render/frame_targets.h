#pragma once

#include <cstdint>
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
  bool has(BufferId id) const { return targets_.contains(id); }
  core::ImageSize size(BufferId id) const;

  /// To read on the device.
  const gl::Texture& texture(BufferId id);
  /// To read or draw on the device, with the stencil of `liquid` where the target uses one.
  GLuint framebuffer(BufferId id, std::uint8_t liquid = 0);
  /// To draw into a surface's stencil, and not into the surface.
  GLuint stencilFramebuffer(std::uint8_t liquid);
  /// To draw into all of it on the device; 0 everywhere before.
  void clear(BufferId id);

  /// Row by row from the top. Only for buffers of floats.
  std::span<const float> read(BufferId id);
  std::span<float> change(BufferId id);
  /// All 0.
  std::span<float> startAnew(BufferId id);

  /// The stencil of a liquid's surface: no liquid anywhere.
  void clearStencil(std::uint8_t liquid);

 private:
  enum class Newest { Both, Device, Memory };

  struct Target {
    PictureBuffer buffer;
    gl::Texture texture;
    /// One alone, or, where all liquids draw into it, one with the stencil of each.
    std::vector<gl::Framebuffer> framebuffers;
    std::vector<float> memory;
    Newest newest = Newest::Device;

    GLuint framebuffer(std::uint8_t liquid) const {
      return framebuffers[liquid < framebuffers.size() ? liquid : 0].name();
    }
  };

  void make(const PictureBuffer& buffer, const FramePlan& plan);
  Target& target(BufferId id);
  static void toDevice(Target& target);
  static void toMemory(Target& target);

  std::vector<PictureBuffer> buffers_;
  std::map<BufferId, Target> targets_;
  std::vector<gl::Renderbuffer> stencils_;  ///< One for each liquid.
};

/// The targets as one liquid's passes see them: its own surface, thickness and so on, and what all have in common.
class LiquidTargets {
 public:
  LiquidTargets(FrameTargets& targets, std::uint8_t liquid) : targets_(&targets), liquid_(liquid) {}

  bool has(Resource resource) const { return targets_->has(id(resource)); }
  core::ImageSize size(Resource resource) const { return targets_->size(id(resource)); }
  const gl::Texture& texture(Resource resource) const { return targets_->texture(id(resource)); }
  const gl::Texture& texture(BufferId id) const { return targets_->texture(id); }
  GLuint framebuffer(Resource resource) const { return targets_->framebuffer(id(resource), liquid_); }
  GLuint stencilFramebuffer() const { return targets_->stencilFramebuffer(liquid_); }
  void clear(Resource resource) const { targets_->clear(id(resource)); }
  std::span<const float> read(Resource resource) const { return targets_->read(id(resource)); }
  std::span<const float> read(BufferId id) const { return targets_->read(id); }
  std::span<float> change(Resource resource) const { return targets_->change(id(resource)); }
  std::span<float> startAnew(Resource resource) const { return targets_->startAnew(id(resource)); }
  void clearStencil() const { targets_->clearStencil(liquid_); }

  /// The same, where `surface` stands for Resource::Surface.
  LiquidTargets withSurface(Resource surface) const {
    LiquidTargets targets = *this;
    targets.surface_ = surface;
    return targets;
  }

 private:
  BufferId id(Resource resource) const {
    if (resource == Resource::Surface) resource = surface_;
    return {resource, isOfLiquid(resource) ? liquid_ : std::uint8_t{0}};
  }

  FrameTargets* targets_;
  std::uint8_t liquid_;
  Resource surface_ = Resource::Surface;
};

}  // namespace sluice::render
