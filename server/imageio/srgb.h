#pragma once

#include <cstdint>
#include <span>

namespace sluice::imageio {

/// Linear light of an sRGB value of 0..1, IEC 61966-2-1.
float linearOfSrgb(float value);

/// Linear light of values of 0..255, or 0..65535. Both spans have the same length.
void toLinear(std::span<const std::uint8_t> srgb, std::span<float> linear);
void toLinear(std::span<const std::uint16_t> srgb, std::span<float> linear);

}  // namespace sluice::imageio
