#include "frame_targets.h"

#include <algorithm>
#include <array>

#include "sluice/core/check.h"

namespace sluice::render {

namespace {

GLenum internalFormat(PixelFormat format) {
  switch (format) {
    case PixelFormat::Srgb8Alpha8:
      return GL_SRGB8_ALPHA8;
    case PixelFormat::R32f:
      return GL_R32F;
    case PixelFormat::Stencil8:
      return GL_STENCIL_INDEX8;
  }
  return GL_NONE;
}

/// Read between pixels: where light is looked up, and the thickness, which may be smaller than the picture.
bool isInterpolated(Resource resource) {
  return resource == Resource::Background || resource == Resource::Scene || resource == Resource::Liquid ||
         resource == Resource::Thickness;
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
  const PictureBuffer* stencil = plan.buffer(Resource::Stencil);
  stencil_ =
      stencil == nullptr ? gl::Renderbuffer{} : gl::makeRenderbuffer(internalFormat(stencil->format), stencil->size);
  // Owners of memory before those who use it.
  for (const bool shared : {false, true}) {
    for (const PictureBuffer& buffer : plan.buffers) {
      if (buffer.resource != Resource::Stencil && buffer.sharedWith.has_value() == shared) make(buffer, stencil);
    }
  }
}

void FrameTargets::make(const PictureBuffer& buffer, const PictureBuffer* stencil) {
  auto [entry, isNew] = targets_.try_emplace(buffer.resource);
  Target& target = entry->second;
  if (isNew || buffer.sharedWith) {
    const GLenum format = internalFormat(buffer.format);
    target.buffer = buffer;
    target.texture = buffer.sharedWith ? gl::makeTextureView(targets_.at(*buffer.sharedWith).texture, format)
                                       : gl::makeTexture(format, buffer.size);
    target.newest = Newest::Device;
    if (isInterpolated(buffer.resource)) gl::setBilinear(target.texture);
  }
  const bool masked = stencil != nullptr && stencil->size == buffer.size && usesStencil(buffer.resource);
  target.framebuffer = masked ? gl::makeFramebuffer(target.texture, stencil_) : gl::makeFramebuffer(target.texture);
}

FrameTargets::Target& FrameTargets::target(Resource resource) {
  const auto found = targets_.find(resource);
  SLUICE_CHECK(found != targets_.end());
  return found->second;
}

core::ImageSize FrameTargets::size(Resource resource) const {
  const auto found = targets_.find(resource);
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
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.name());
  glReadPixels(0, 0, size.width, size.height, GL_RED, GL_FLOAT, target.memory.data());
  target.newest = Newest::Both;
}

const gl::Texture& FrameTargets::texture(Resource resource) {
  Target& found = target(resource);
  toDevice(found);
  return found.texture;
}

GLuint FrameTargets::framebuffer(Resource resource) {
  Target& found = target(resource);
  toDevice(found);
  found.newest = Newest::Device;
  return found.framebuffer.name();
}

void FrameTargets::clear(Resource resource) {
  constexpr std::array<GLfloat, 4> kNothing{};
  Target& found = target(resource);
  found.newest = Newest::Device;
  glClearNamedFramebufferfv(found.framebuffer.name(), GL_COLOR, 0, kNothing.data());
}

std::span<const float> FrameTargets::read(Resource resource) {
  Target& found = target(resource);
  toMemory(found);
  return found.memory;
}

std::span<float> FrameTargets::change(Resource resource) {
  Target& found = target(resource);
  toMemory(found);
  found.newest = Newest::Memory;
  return found.memory;
}

std::span<float> FrameTargets::startAnew(Resource resource) {
  Target& found = target(resource);
  SLUICE_CHECK(found.buffer.format == PixelFormat::R32f);
  const core::ImageSize size = found.buffer.size;
  found.memory.assign(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height), 0.0F);
  found.newest = Newest::Memory;
  return found.memory;
}

void FrameTargets::clearStencil() {
  constexpr GLint kNoLiquid = 0;
  glClearNamedFramebufferiv(target(Resource::Surface).framebuffer.name(), GL_STENCIL, 0, &kNoLiquid);
}

}  // namespace sluice::render
