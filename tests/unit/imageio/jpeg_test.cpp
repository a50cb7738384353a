#include <gmock/gmock.h>

#include "srgb.h"
#include "write_images.h"

namespace sluice::imageio::test {
namespace {

using ::testing::HasSubstr;

/// Left half red, right half grey: 32x16.
Bytes halves() {
  Bytes rgb;
  for (int i = 0; i < 32 * 16; ++i) {
    const bool left = i % 32 < 16;
    for (const int value : {left ? 200 : 90, left ? 20 : 90, left ? 30 : 90}) {
      rgb.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return rgb;
}

TEST(Jpeg, HoldsItsColoursAsLinearLight) {
  for (const bool progressive : {false, true}) {
    const LinearImage image = decodeImage(jpeg({32, 16}, halves(), progressive), "file");
    ASSERT_EQ(image.size, (core::ImageSize{32, 16}));
    // Quality 95 keeps flat colours to about 2 of 255.
    const std::size_t left = 3 * (8 * 32 + 4);
    const std::size_t right = 3 * (8 * 32 + 27);
    EXPECT_NEAR(image.values[left], linearOfSrgb(200 / 255.0F), 0.02F);
    EXPECT_NEAR(image.values[left + 1], linearOfSrgb(20 / 255.0F), 0.004F);
    EXPECT_NEAR(image.values[right], linearOfSrgb(90 / 255.0F), 0.008F);
    EXPECT_NEAR(image.values[right + 2], linearOfSrgb(90 / 255.0F), 0.008F);
  }
}

TEST(Jpeg, WhatIsMissingIsNotMadeUp) {
  Bytes bytes = jpeg({32, 16}, halves());
  bytes.resize(bytes.size() - 20);
  EXPECT_THAT(decodeError(bytes), HasSubstr("file: is no JPEG that can be read"));
}

TEST(Jpeg, HugeSizesAreRefused) {
  Bytes bytes = jpeg({32, 16}, halves());
  // Start of frame: FF C0, length, precision, height, width.
  const auto frame = std::ranges::search(bytes, Bytes{0xFF, 0xC0}).begin() - bytes.begin();
  for (std::ptrdiff_t i = 5; i < 9; ++i) bytes[static_cast<std::size_t>(frame + i)] = 0xF0;
  EXPECT_THAT(decodeError(bytes), HasSubstr("61680x61680 pixels; allowed are"));
}

}  // namespace
}  // namespace sluice::imageio::test
