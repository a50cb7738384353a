#include "frame_targets.h"

#include <algorithm>
#include <array>

#include "sluice/core/check.h"

namespace sluice::render {

namespace {

GLenum internalFormat(PixelFormat format) {
  switch (format) {
    case PixelFormat::Rgba32f:
      return GL_RGBA32F;
    case PixelFormat::Rgba16f:
      return GL_RGBA16F;
    case PixelFormat::Srgb8Alpha8:
      return GL_SRGB8_ALPHA8;
    case PixelFormat::R32f:
      return GL_R32F;
    case PixelFormat::Rg32f:
      return GL_RG32F;
    case PixelFormat::Stencil8:
      return GL_STENCIL_INDEX8;
    case PixelFormat::Rgba16fDepth32fTimes4:
    case PixelFormat::Rgba16fRg32fTimes6:
      break;  // several textures, which their pass makes
  }
  return GL_NONE;
}

/// Read between pixels: where light is looked up, and the thickness, which may be smaller than the picture.
bool isInterpolated(Resource resource) {
  return resource == Resource::Background || resource == Resource::Scene || resource == Resource::Liquid ||
         resource == Resource::Thickness || resource == Resource::Attribute;
}

/// Drawn where the stencil says that there is liquid.
bool usesStencil(Resource resource) {
  return isSurface(resource) || resource == Resource::Liquid || resource == Resource::Picture;
}

}  // namespace

void FrameTargets::fit(const FramePlan& plan) {
  if (plan.buffers == buffers_) return;
  buffers_ = plan.buffers;
  std::erase_if(targets_, [&](const auto& entry) {
    const PictureBuffer* needed = plan.buffer(entry.first);
    return needed == nullptr || *needed != entry.second.buffer;
  });
  stencils_.clear();
  stencils_.resize(plan.surfaces.size());
  for (std::size_t k = 0; k < stencils_.size(); ++k) {
    const PictureBuffer* stencil = plan.buffer(Resource::Stencil, k);
    if (stencil != nullptr) stencils_[k] = gl::makeRenderbuffer(internalFormat(stencil->format), stencil->size);
  }
  // Owners of memory before those who use it.
  for (const bool shared : {false, true}) {
    for (const PictureBuffer& buffer : plan.buffers) {
      if (isKeptByItsPass(buffer.id.resource)) continue;
      if (buffer.id.resource != Resource::Stencil && buffer.sharedWith.has_value() == shared) make(buffer, plan);
    }
  }
}

void FrameTargets::make(const PictureBuffer& buffer, const FramePlan& plan) {
  auto [entry, isNew] = targets_.try_emplace(buffer.id);
  Target& target = entry->second;
  if (isNew || buffer.sharedWith) {
    const GLenum format = internalFormat(buffer.format);
    target.buffer = buffer;
    target.texture = buffer.sharedWith ? gl::makeTextureView(targets_.at(*buffer.sharedWith).texture, format)
                                       : gl::makeTexture(format, buffer.size);
    target.newest = Newest::Device;
    if (isInterpolated(buffer.id.resource)) gl::setBilinear(target.texture);
  }
  const auto withStencilOf = [&](std::size_t liquid) {
    const PictureBuffer* stencil = plan.buffer(Resource::Stencil, liquid);
    const bool masked = stencil != nullptr && stencil->size == buffer.size && usesStencil(buffer.id.resource);
    return masked ? gl::makeFramebuffer(target.texture, stencils_[liquid]) : gl::makeFramebuffer(target.texture);
  };
  target.framebuffers.clear();
  if (isOfLiquid(buffer.id.resource)) {
    target.framebuffers.push_back(withStencilOf(buffer.id.liquid));
  } else {
    for (std::size_t k = 0; k < std::max<std::size_t>(1, stencils_.size()); ++k) {
      target.framebuffers.push_back(withStencilOf(k));
    }
  }
}

FrameTargets::Target& FrameTargets::target(BufferId id) {
  const auto found = targets_.find(id);
  SLUICE_CHECK(found != targets_.end());
  return found->second;
}

core::ImageSize FrameTargets::size(BufferId id) const {
  const auto found = targets_.find(id);
  SLUICE_CHECK(found != targets_.end());
  return found->second.buffer.size;
}

void FrameTargets::toDevice(Target& target) {
  if (target.newest != Newest::Memory) return;
  const core::ImageSize size = target.buffer.size;
  glTextureSubImage2D(target.texture.name(), 0, 0, 0, size.width, size.height, GL_RED, GL_FLOAT, target.memory.data());
  target.newest = Newest::Both;
}

void FrameTargets::toMemory(Target& target) {
  SLUICE_CHECK(target.buffer.format == PixelFormat::R32f);
  const core::ImageSize size = target.buffer.size;
  target.memory.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  if (target.newest != Newest::Device) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer(0));
  glReadPixels(0, 0, size.width, size.height, GL_RED, GL_FLOAT, target.memory.data());
  target.newest = Newest::Both;
}

const gl::Texture& FrameTargets::texture(BufferId id) {
  Target& found = target(id);
  toDevice(found);
  return found.texture;
}

GLuint FrameTargets::framebuffer(BufferId id, std::uint8_t liquid) {
  Target& found = target(id);
  toDevice(found);
  found.newest = Newest::Device;
  return found.framebuffer(liquid);
}

GLuint FrameTargets::stencilFramebuffer(std::uint8_t liquid) {
  return target({Resource::Surface, liquid}).framebuffer(liquid);
}

void FrameTargets::clear(BufferId id) {
  constexpr std::array<GLfloat, 4> kNothing{};
  Target& found = target(id);
  found.newest = Newest::Device;
  glClearNamedFramebufferfv(found.framebuffer(0), GL_COLOR, 0, kNothing.data());
}

std::span<const float> FrameTargets::read(BufferId id) {
  Target& found = target(id);
  toMemory(found);
  return found.memory;
}

std::span<float> FrameTargets::change(BufferId id) {
  Target& found = target(id);
  toMemory(found);
  found.newest = Newest::Memory;
  return found.memory;
}

std::span<float> FrameTargets::startAnew(BufferId id) {
  Target& found = target(id);
  SLUICE_CHECK(found.buffer.format == PixelFormat::R32f);
  const core::ImageSize size = found.buffer.size;
  found.memory.assign(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height), 0.0F);
  found.newest = Newest::Memory;
  return found.memory;
}

void FrameTargets::clearStencil(std::uint8_t liquid) {
  constexpr GLint kNoLiquid = 0;
  glClearNamedFramebufferiv(target({Resource::Surface, liquid}).framebuffer(0), GL_STENCIL, 0, &kNoLiquid);
}

}  // namespace sluice::render
