#include "noise_rows.h"

#include <algorithm>
#include <cmath>

#include "sluice/core/simd.h"

namespace sluice::render {

namespace {

// Helpers of cloned functions must be inlined, or every clone would call the one version for all instruction sets.
// The same terms stand in shaders/gradient_noise.glsl.

/// Odd numbers far from simple fractions of 2³²: of the golden ratio, and of xxHash.
constexpr std::uint32_t kStepX = 0x9e3779b1U;
constexpr std::uint32_t kStepY = 0x85ebca77U;

/// t³(t(6t−15)+10), whose second derivative has no jump between cells [Perlin 2002].
[[gnu::always_inline]] inline float fade(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }

/// The gradient at a point of the lattice times the way from there.
[[gnu::always_inline]] inline float ramp(std::uint32_t point, float x, float y) {
  point ^= point >> 15;
  point *= 0x2c1b3c6dU;
  point ^= point >> 14;
  constexpr float kScale = 2.0F / 65535.0F;
  const float gradientX = static_cast<float>(static_cast<std::int32_t>(point & 0xffffU)) * kScale - 1.0F;
  const float gradientY = static_cast<float>(static_cast<std::int32_t>(point >> 16)) * kScale - 1.0F;
  return gradientX * x + gradientY * y;
}

[[gnu::always_inline]] inline float gradientNoise(float x, float y, std::uint32_t seed) {
  const auto column = static_cast<std::int32_t>(x);
  const auto line = static_cast<std::int32_t>(y);
  const float fx = x - static_cast<float>(column);
  const float fy = y - static_cast<float>(line);
  const std::uint32_t point =
      static_cast<std::uint32_t>(column) * kStepX + static_cast<std::uint32_t>(line) * kStepY + seed;
  const float a = ramp(point, fx, fy);
  const float b = ramp(point + kStepX, fx - 1.0F, fy);
  const float c = ramp(point + kStepY, fx, fy - 1.0F);
  const float d = ramp(point + kStepX + kStepY, fx - 1.0F, fy - 1.0F);
  const float u = fade(fx);
  const float upper = a + u * (b - a);
  const float lower = c + u * (d - c);
  return upper + fade(fy) * (lower - upper);
}

template <bool withViolence>
[[gnu::always_inline]] inline void addRow(const NoiseSprite& s, float perFallOff, float slopeY,
                                          const float* __restrict slopes, const float* __restrict depths,
                                          float* __restrict height, float* __restrict square,
                                          float* __restrict violence, int count) {
  const float perRadius = 1.0F / s.radius;
  const float perSlope = s.z * perRadius;
  const float left = s.x * perRadius;
  const float y = slopeY * perSlope - s.y * perRadius;
  const float rowX = s.originX - s.turnY * y;
  const float rowY = s.originY + s.turnX * y;
  const float room = 1.0F - y * y;
  const float turnX = s.turnX;
  const float turnY = s.turnY;
  const float z = s.z;
  const float scale = s.height;
  const float mark = s.violence;
  const std::uint32_t seed = s.seed;
  for (int first = 0; first < count; first += kNoiseBlock) {
#pragma GCC ivdep
    for (int i = first; i < first + kNoiseBlock; ++i) {
      const float x = slopes[i] * perSlope - left;
      const float kernel = std::max(room - x * x, 0.0F);
      const float below = (z - depths[i]) * perFallOff;
      float fall = std::max(1.0F - 0.25F * below * below, 0.0F);
      fall *= fall;
      fall *= fall;
      const float weight = kernel * kernel * fall;
      height[i] += weight * scale * gradientNoise(turnX * x + rowX, turnY * x + rowY, seed);
      square[i] += weight * weight;
      if (withViolence) violence[i] += weight * weight * mark;
    }
  }
}

SLUICE_SIMD_CLONES void addPlain(const NoiseSprite& sprite, float perFallOff, float slopeY, const float* slopes,
                                 const float* depths, float* height, float* square, int count) {
  addRow<false>(sprite, perFallOff, slopeY, slopes, depths, height, square, nullptr, count);
}

SLUICE_SIMD_CLONES void addViolent(const NoiseSprite& sprite, float perFallOff, float slopeY, const float* slopes,
                                   const float* depths, float* height, float* square, float* violence, int count) {
  addRow<true>(sprite, perFallOff, slopeY, slopes, depths, height, square, violence, count);
}

constexpr float kLeastSquare = kNoiseLeastWeight * kNoiseLeastWeight;

}  // namespace

void addNoiseRow(const NoiseSprite& sprite, float perFallOff, float slopeY, const float* slopes, const float* depths,
                 const NoiseRow& row, int count) {
  if (row.violence == nullptr) {
    addPlain(sprite, perFallOff, slopeY, slopes, depths, row.height, row.square, count);
  } else {
    addViolent(sprite, perFallOff, slopeY, slopes, depths, row.height, row.square, row.violence, count);
  }
}

void finishNoise(const NoiseRow& row, float* height, int count) {
  for (int i = 0; i < count; ++i) height[i] = row.height[i] / std::sqrt(row.square[i] + kLeastSquare);
}

void finishViolence(const NoiseRow& row, float* violence, int count) {
  for (int i = 0; i < count; ++i) violence[i] = row.violence[i] / (row.square[i] + kLeastSquare);
}

}  // namespace sluice::render
