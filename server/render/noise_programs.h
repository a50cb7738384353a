#pragma once

#include <cstddef>
#include <span>

#include "noise_sprites.h"
#include "sluice/gl/objects.h"

namespace sluice::render {

/// What draws noise on a device: its programs, and the sprites there.
class NoisePrograms {
 public:
  NoisePrograms();

  const gl::Program& sum() const { return sum_; }
  const gl::Program& finishNoise() const { return finishNoise_; }
  const gl::Program& finishViolence() const { return finishViolence_; }

  void upload(std::span<const NoiseSprite> sprites);
  /// Draws a square of four vertices for each sprite.
  void drawSprites() const;

 private:
  gl::Program sum_;
  gl::Program finishNoise_;
  gl::Program finishViolence_;
  gl::StreamBuffer buffer_;
  gl::VertexArray array_;
  std::size_t count_ = 0;
};

}  // namespace sluice::render
