#include "i420_picture.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "sluice/core/check.h"
#include "sluice/core/simd.h"

namespace sluice::encode {

namespace {

// BT.709-6, items 3.2 and 3.3: Y' = 0.2126 R' + 0.7152 G' + 0.0722 B', Cb = (B' − Y') / 1.8556, Cr = (R' − Y')
// / 1.5748; item 4.6 stretches them over 219 and 224 levels. In units of 1/32768, so that products with sums of four
// pixels of 8 bit stay within 32 bits. libyuv has this direction for BT.601 alone.
constexpr double kOne = 32768;
constexpr double kKr = 0.2126;
constexpr double kKb = 0.0722;
constexpr double kKg = 1 - kKr - kKb;
constexpr double kLuma = 219.0 / 255 * kOne;
constexpr double kChroma = 224.0 / 255 * kOne;

constexpr int rounded(double value) { return static_cast<int>(value < 0 ? value - 0.5 : value + 0.5); }

struct Weights {
  int r, g, b;
};
constexpr Weights kY = {rounded(kLuma * kKr), rounded(kLuma* kKg), rounded(kLuma* kKb)};
constexpr double kCbScale = kChroma / (2 * (1 - kKb));
constexpr double kCrScale = kChroma / (2 * (1 - kKr));
// The last weight of each makes their sum 0, so that grey stays grey.
constexpr Weights kCb = {rounded(-kCbScale * kKr), -rounded(-kCbScale* kKr) - rounded(kCbScale*(1 - kKb)),
                         rounded(kCbScale*(1 - kKb))};
constexpr Weights kCr = {rounded(kCrScale * (1 - kKr)), -rounded(kCrScale*(1 - kKr)) - rounded(-kCrScale* kKb),
                         rounded(-kCrScale* kKb)};

constexpr int kBits = 15;
constexpr int kHalf = 1 << (kBits - 1);
constexpr int kLumaOffset = (16 << kBits) + kHalf;
// Chroma is taken of the sum of four pixels: two bits more.
constexpr int kChromaOffset = (128 << (kBits + 2)) + (kHalf << 2);

SLUICE_SIMD_CLONES void lumaRow(const std::uint32_t* __restrict pixels, int width, std::uint8_t* __restrict y) {
  for (int x = 0; x < width; ++x) {
    const auto pixel = static_cast<int>(pixels[x] & 0xFFFFFFU);
    const int sum = kY.r * (pixel & 0xFF) + kY.g * ((pixel >> 8) & 0xFF) + kY.b * (pixel >> 16);
    y[x] = static_cast<std::uint8_t>((sum + kLumaOffset) >> kBits);
  }
}

SLUICE_SIMD_CLONES void chromaRow(const std::uint32_t* __restrict top, const std::uint32_t* __restrict bottom,
                                  int pairs, std::uint8_t* __restrict u, std::uint8_t* __restrict v) {
  // Red and blue are summed together, 16 bits each.
  constexpr std::uint32_t kRedBlue = 0x00FF00FFU;
  for (int x = 0; x < pairs; ++x) {
    const std::uint32_t a = top[2 * x], b = top[2 * x + 1], c = bottom[2 * x], d = bottom[2 * x + 1];
    const std::uint32_t redBlue = (a & kRedBlue) + (b & kRedBlue) + (c & kRedBlue) + (d & kRedBlue);
    const auto green = static_cast<int>(((a >> 8) & 0xFF) + ((b >> 8) & 0xFF) + ((c >> 8) & 0xFF) + ((d >> 8) & 0xFF));
    const auto red = static_cast<int>(redBlue & 0xFFFF);
    const auto blue = static_cast<int>(redBlue >> 16);
    u[x] = static_cast<std::uint8_t>((kCb.r * red + kCb.g * green + kCb.b * blue + kChromaOffset) >> (kBits + 2));
    v[x] = static_cast<std::uint8_t>((kCr.r * red + kCr.g * green + kCr.b * blue + kChromaOffset) >> (kBits + 2));
  }
}

}  // namespace

void toI420(const std::uint8_t* rgba, core::ImageSize size, core::ImageSize codedSize, const I420Planes& planes) {
  const auto [width, height] = size;
  SLUICE_CHECK(codedSize.width - width <= 1 && codedSize.height - height <= 1);
  const int evenWidth = width + width % 2;
  // Rows of an odd width are copied, their last pixel twice.
  std::vector<std::uint32_t> copies(evenWidth != width ? 2U * evenWidth : 0U);
  const auto rowOf = [&, w = width, h = height](int y, int slot) {
    const std::uint8_t* row = rgba + 4U * static_cast<std::size_t>(w) * std::min(y, h - 1);
    if (evenWidth == w) return reinterpret_cast<const std::uint32_t*>(row);
    std::uint32_t* copy = copies.data() + static_cast<std::ptrdiff_t>(slot) * evenWidth;
    std::memcpy(copy, row, 4U * static_cast<std::size_t>(w));
    copy[w] = copy[w - 1];
    return static_cast<const std::uint32_t*>(copy);
  };
  for (int y = 0; y < height; y += 2) {
    const std::uint32_t* top = rowOf(y, 0);
    const std::uint32_t* bottom = rowOf(y + 1, 1);
    lumaRow(top, codedSize.width, planes.y + static_cast<std::ptrdiff_t>(y) * planes.strideY);
    if (y + 1 < codedSize.height) {
      lumaRow(bottom, codedSize.width, planes.y + static_cast<std::ptrdiff_t>(y + 1) * planes.strideY);
    }
    const std::ptrdiff_t half = y / 2;
    chromaRow(top, bottom, evenWidth / 2, planes.u + half * planes.strideU, planes.v + half * planes.strideV);
  }
}

}  // namespace sluice::encode
