#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

#include "sluice/core/camera.h"

namespace sluice::gl {

/// Owns one GL name and deletes it. Move-only; a moved-from object holds 0, which GL ignores. Lives on the thread of
/// the context that was current when it was made.
template <class Traits>
class Object {
 public:
  Object() = default;
  explicit Object(GLuint name) : name_(name) {}
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  ~Object() { reset(); }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  void reset() {
    if (name_ != 0) Traits::destroy(name_);
    name_ = 0;
  }

  GLuint name_ = 0;
};

struct TextureTraits {
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct FramebufferTraits {
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct RenderbufferTraits {
  static void destroy(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct VertexArrayTraits {
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct ShaderTraits {
  static void destroy(GLuint name) { glDeleteShader(name); }
};
struct ProgramTraits {
  static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct QueryTraits {
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
struct BufferTraits {
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};

using Texture = Object<TextureTraits>;
using Framebuffer = Object<FramebufferTraits>;
using Renderbuffer = Object<RenderbufferTraits>;
using VertexArray = Object<VertexArrayTraits>;
using Shader = Object<ShaderTraits>;
using Program = Object<ProgramTraits>;
using Query = Object<QueryTraits>;
using Buffer = Object<BufferTraits>;

/// One level, without filtering between texels; reads outside the picture give 0.
Texture makeTexture(GLenum internalFormat, core::ImageSize size);

/// The memory of a texture read and drawn as another format of as many bytes. Either may be deleted first.
Texture makeTextureView(const Texture& texture, GLenum internalFormat);

/// Between texels, reads are interpolated; outside the picture they repeat its edge.
void setBilinear(const Texture& texture);

Renderbuffer makeRenderbuffer(GLenum internalFormat, core::ImageSize size);

/// A framebuffer with one colour attachment. `stencil` may be an empty object.
Framebuffer makeFramebuffer(const Texture& colour, const Renderbuffer& stencil = {});

VertexArray makeVertexArray();
Query makeTimestampQuery();

/// A buffer that grows to the largest content it has held.
class StreamBuffer {
 public:
  /// Replaces the content; what the GPU may still read of the old content stays intact.
  void upload(std::span<const std::byte> bytes);

  GLuint name() const { return buffer_.name(); }
  std::size_t capacity() const { return capacity_; }

 private:
  Buffer buffer_;
  std::size_t capacity_ = 0;
};

}  // namespace sluice::gl
