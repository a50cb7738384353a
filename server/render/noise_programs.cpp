#include "noise_programs.h"

#include <array>
#include <string_view>

#include "frame_context.h"

namespace sluice::render {

namespace {

constexpr std::array<std::string_view, 1> kViolence{"VIOLENCE"};

/// Attributes of noise.vert, one after another as in NoiseSprite.
void describeSprites(const gl::VertexArray& array) {
  const auto describe = [&](GLuint attribute, GLint components, std::size_t offset) {
    glEnableVertexArrayAttrib(array.name(), attribute);
    glVertexArrayAttribFormat(array.name(), attribute, components, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array.name(), attribute, 0);
  };
  describe(0, 4, offsetof(NoiseSprite, x));
  describe(1, 4, offsetof(NoiseSprite, turnX));
  glEnableVertexArrayAttrib(array.name(), 2);
  glVertexArrayAttribIFormat(array.name(), 2, 1, GL_UNSIGNED_INT, offsetof(NoiseSprite, seed));
  glVertexArrayAttribBinding(array.name(), 2, 0);
  describe(3, 2, offsetof(NoiseSprite, height));
  // One sprite for all four vertices.
  glVertexArrayBindingDivisor(array.name(), 0, 1);
}

}  // namespace

NoisePrograms::NoisePrograms()
    : sum_(shaders().program("noise.vert", "noise.frag")),
      finishNoise_(shaders().program("picture.vert", "finish_noise.frag")),
      finishViolence_(shaders().program("picture.vert", "finish_noise.frag", kViolence)),
      array_(gl::makeVertexArray()) {
  describeSprites(array_);
}

void NoisePrograms::upload(std::span<const NoiseSprite> sprites) {
  count_ = sprites.size();
  buffer_.upload(std::as_bytes(sprites));
  glVertexArrayVertexBuffer(array_.name(), 0, buffer_.name(), 0, sizeof(NoiseSprite));
}

void NoisePrograms::drawSprites() const {
  glBindVertexArray(array_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count_));
}

}  // namespace sluice::render
