#include "sluice/gl/objects.h"

#include <algorithm>
#include <array>

#include "sluice/core/check.h"

namespace sluice::gl {

namespace {

void readPlainly(GLuint texture) {
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  constexpr std::array<GLfloat, 4> kNothing{};
  glTextureParameterfv(texture, GL_TEXTURE_BORDER_COLOR, kNothing.data());
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
}

}  // namespace

Texture makeTexture(GLenum internalFormat, core::ImageSize size) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  Texture texture(name);
  glTextureStorage2D(name, 1, internalFormat, size.width, size.height);
  readPlainly(name);
  return texture;
}

Texture makeTextureView(const Texture& texture, GLenum internalFormat) {
  // A view needs a name that is not a texture yet, which glCreateTextures does not give.
  GLuint name = 0;
  glGenTextures(1, &name);
  Texture view(name);
  glTextureView(name, GL_TEXTURE_2D, texture.name(), internalFormat, 0, 1, 0, 1);
  readPlainly(name);
  return view;
}

void setBilinear(const Texture& texture) {
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Renderbuffer makeRenderbuffer(GLenum internalFormat, core::ImageSize size) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  Renderbuffer renderbuffer(name);
  glNamedRenderbufferStorage(name, internalFormat, size.width, size.height);
  return renderbuffer;
}

Framebuffer makeFramebuffer(const Texture& colour, const Renderbuffer& stencil) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour.name(), 0);
  if (stencil) glNamedFramebufferRenderbuffer(name, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, stencil.name());
  SLUICE_CHECK_EQ(glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER), GLenum{GL_FRAMEBUFFER_COMPLETE});
  return framebuffer;
}

VertexArray makeVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

Query makeTimestampQuery() {
  GLuint name = 0;
  glCreateQueries(GL_TIMESTAMP, 1, &name);
  return Query(name);
}

void StreamBuffer::upload(std::span<const std::byte> bytes) {
  if (!buffer_) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    buffer_ = Buffer(name);
  }
  capacity_ = std::max(capacity_, bytes.size());
  if (capacity_ == 0) return;
  // A new store each time ("orphaning"): the driver need not wait for draws that still read the old one.
  glNamedBufferData(buffer_.name(), static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
  glNamedBufferSubData(buffer_.name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

}  // namespace sluice::gl
