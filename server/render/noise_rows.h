#pragma once

#include "noise_sprites.h"

namespace sluice::render {

/// Pixels of noise drawn at once; rows are padded by as many.
inline constexpr int kNoiseBlock = 8;

/// How deep below the surface, in fall-off lengths, noise has faded to nothing, see addNoiseRow.
inline constexpr float kNoiseReach = 2.0F;

/// Eye depth that stands for "no liquid": so far off that no noise reaches it.
inline constexpr float kNoLiquid = 1e15F;

/// One row of the sums of a picture of noise.
struct NoiseRow {
  float* height;    ///< Σ w·(height)·(noise), m.
  float* square;    ///< Σ w².
  float* violence;  ///< Σ w²·violence, or null.
};

/// Adds one sprite to a row, from the pixel at whose middle the line of sight is (slopes[0], slopeY). `depths` are the
/// surface's eye depths there, m, and `perFallOff` is 1 over the fall-off length, 1/m. Draws whole blocks: up to
/// kNoiseBlock − 1 pixels beyond `count`, where the sprite belongs as well, if it is there at all.
///
/// The weight is w = (1−ρ²)²·(1−u²/4)⁴ for ρ < 1 and u < 2, with ρ the distance in radii and u the depth below the
/// surface in fall-off lengths: both end smoothly, where e^(−ρ²) of Eq. (10) [vdL09] is cut at ρ = 1, and the second
/// factor is never more than 0.08 from the e^(−u²) that it stands for.
void addNoiseRow(const NoiseSprite& sprite, float perFallOff, float slopeY, const float* slopes, const float* depths,
                 const NoiseRow& row, int count);

/// The noise of the sums, N = Σ w h n/√(Σw² + ε²), m. Sums of many pieces of noise that know nothing of each other have
/// the variance Σw²h²: divided like this, the noise is as strong wherever and however many particles are near. A mean,
/// divided by Σw, would be the weaker the more there are.
void finishNoise(const NoiseRow& row, float* height, int count);
/// The mean violence, Σw²m/(Σw² + ε²).
void finishViolence(const NoiseRow& row, float* violence, int count);

/// ε: where no particle is near enough for a weight like this, noise fades out instead of being scaled up.
inline constexpr float kNoiseLeastWeight = 0.1F;

}  // namespace sluice::render
