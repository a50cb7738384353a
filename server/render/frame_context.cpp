#include "frame_context.h"

#include "sluice/render/embedded_shaders.h"

namespace sluice::render {

const gl::ShaderLibrary& shaders() {
  static const gl::ShaderLibrary library = [] {
    std::vector<gl::ShaderSource> sources;
    for (const EmbeddedFile& file : embeddedFiles()) sources.push_back({file.name, file.text});
    return gl::ShaderLibrary(std::move(sources));
  }();
  return library;
}

namespace {

void begin(const FrameContext& frame, Resource resource, GLuint framebuffer) {
  const core::ImageSize size = frame.targets.size(resource);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, size.width, size.height);
  const bool coarse = isAsFineAsSurface(resource);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, coarse ? frame.surfaceUniforms : frame.pictureUniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, 1, frame.liquidUniforms);
  glDisable(GL_BLEND);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CLIP_DISTANCE0);
}

}  // namespace

void beginTarget(const FrameContext& frame, Resource resource) {
  begin(frame, resource, frame.targets.framebuffer(resource));
}

void beginStencil(const FrameContext& frame) {
  begin(frame, Resource::Surface, frame.targets.stencilFramebuffer());
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
}

void endStencil() { glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); }

void bindTexture(const FrameContext& frame, GLuint binding, Resource resource) {
  glBindTextureUnit(binding, frame.targets.texture(resource).name());
}

void copy(const FrameContext& frame, Resource from, Resource to) {
  const core::ImageSize size = frame.targets.size(to);
  frame.targets.framebuffer(to);
  glCopyImageSubData(frame.targets.texture(from).name(), GL_TEXTURE_2D, 0, 0, 0, 0, frame.targets.texture(to).name(),
                     GL_TEXTURE_2D, 0, 0, 0, 0, size.width, size.height, 1);
}

void keepToLiquid() {
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, kLiquidBit, kLiquidBit);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

void keepToLayer(int layer) {
  keepToLiquid();
  glStencilFunc(GL_EQUAL, stencilOf(layer), 0xFF);
}

void drawPicture() { glDrawArrays(GL_TRIANGLES, 0, 3); }

void drawPicture(std::span<const PixelRect> places) {
  for (const PixelRect& place : places) {
    const KeepTo keepTo(place);
    drawPicture();
  }
}

}  // namespace sluice::render
