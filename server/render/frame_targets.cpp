#include "frame_targets.h"

#include <algorithm>

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
  return resource == Resource::Background || resource == Resource::Scene || resource == Resource::Thickness;
}

/// Drawn where the stencil says that there is liquid.
bool usesStencil(Resource resource) {
  return resource == Resource::Surface || resource == Resource::SurfaceScratch || resource == Resource::Picture;
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
  for (const PictureBuffer& buffer : plan.buffers) {
    if (buffer.resource == Resource::Stencil) continue;
    auto [entry, isNew] = targets_.try_emplace(buffer.resource);
    Target& target = entry->second;
    if (isNew) {
      target.buffer = buffer;
      target.texture = gl::makeTexture(internalFormat(buffer.format), buffer.size);
      if (isInterpolated(buffer.resource)) gl::setBilinear(target.texture);
    }
    target.framebuffer = usesStencil(buffer.resource) ? gl::makeFramebuffer(target.texture, stencil_)
                                                      : gl::makeFramebuffer(target.texture);
  }
}

const FrameTargets::Target& FrameTargets::target(Resource resource) const {
  const auto found = targets_.find(resource);
  SLUICE_CHECK(found != targets_.end());
  return found->second;
}

}  // namespace sluice::render
