#include "srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sluice::imageio {

namespace {

std::array<float, 256> makeTable() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = linearOfSrgb(static_cast<float>(i) / 255.0F);
  return table;
}

}  // namespace

float linearOfSrgb(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

void toLinear(std::span<const std::uint8_t> srgb, std::span<float> linear) {
  static const std::array<float, 256> kTable = makeTable();
  std::ranges::transform(srgb, linear.begin(), [](std::uint8_t value) { return kTable[value]; });
}

void toLinear(std::span<const std::uint16_t> srgb, std::span<float> linear) {
  std::ranges::transform(srgb, linear.begin(),
                         [](std::uint16_t value) { return linearOfSrgb(static_cast<float>(value) / 65535.0F); });
}

}  // namespace sluice::imageio
