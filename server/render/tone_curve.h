#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// What a screen shows of a linear radiance ≥ 0: the scene's exposure and tone operator, 0 to 1, still linear. The same
/// stands in shaders/tone.glsl.
float toneMapped(float radiance, const v1::Tone& tone);

/// sRGB's encoding of a linear value, 0 to 1.
float encodeSrgb(float linear);

/// Tone mapping and encoding for every half float at once: 64 KiB that make both exact and a look-up. What is not a
/// number, or below 0, is black.
class ToneTable {
 public:
  explicit ToneTable(const v1::Tone& tone);

  /// `radiance` holds half floats, RGBA; `pixels` becomes 8-bit sRGB, RGBA, opaque. Uses the OpenMP team of the calling
  /// thread.
  void apply(std::span<const std::uint16_t> radiance, std::span<std::uint8_t> pixels) const;

 private:
  std::array<std::uint8_t, 1U << 16U> levels_;
};

}  // namespace sluice::render
