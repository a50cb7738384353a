#include <gmock/gmock.h>

#include "write_images.h"

namespace sluice::imageio::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Hdr, FlatPixelsAreMantissaTimesPowerOfTwo) {
  // 128/256 · 2^(129-128) = 1, and so on; an exponent of 0 is black.
  const Bytes pixels{128, 64, 0, 129, 255, 255, 255, 0, 200, 100, 50, 140};
  const LinearImage image = decodeImage(hdr("-Y 1 +X 3", pixels), "file");
  EXPECT_EQ(image.size, (core::ImageSize{3, 1}));
  EXPECT_THAT(image.values, ElementsAre(1.0F, 0.5F, 0.0F, 0.0F, 0.0F, 0.0F, 3200.0F, 1600.0F, 800.0F));
}

TEST(Hdr, NewRunsAndLiteralsMakeScanlines) {
  Bytes pixels{2, 2, 0, 8};
  for (const std::uint8_t red : {8, 1, 2, 3, 4, 5, 6, 7, 8}) pixels.push_back(red);   // eight literals
  for (int i = 0; i < 2; ++i) pixels.insert(pixels.end(), {128 + 3, 7, 128 + 5, 9});  // two runs
  pixels.insert(pixels.end(), {128 + 8, 136});
  const LinearImage image = decodeImage(hdr("-Y 1 +X 8", pixels), "file");
  for (std::size_t x = 0; x < 8; ++x) {
    EXPECT_EQ(image.values[3 * x], static_cast<float>(x + 1));
    EXPECT_EQ(image.values[3 * x + 1], x < 3 ? 7.0F : 9.0F);
  }
}

TEST(Hdr, OldRunsRepeatThePixelBefore) {
  // A pixel, 3 more, then 1·256 + 2 more in two runs, the high part second: 1 + 2 + 256 + ... in all 262.
  const Bytes pixels{9, 8, 7, 136, 1, 1, 1, 3, 5, 5, 5, 136, 1, 1, 1, 1, 1, 1, 1, 1};
  const LinearImage image = decodeImage(hdr("-Y 1 +X 262", pixels), "file");
  EXPECT_EQ(image.values[3 * 3], 9.0F);
  EXPECT_EQ(image.values[3 * 4], 5.0F);
  EXPECT_EQ(image.values[3 * 261], 5.0F);
}

TEST(Hdr, ExposureIsTakenBack) {
  const Bytes pixels{128, 128, 128, 129};
  const std::string lines = "FORMAT=32-bit_rle_rgbe\nEXPOSURE= 4\nEXPOSURE=0.5\n";
  EXPECT_THAT(decodeImage(hdr("-Y 1 +X 1", pixels, lines), "file").values, Each(0.5F));
}

/// Three by two pixels that hold 1 2 3 over 4 5 6, stored in each of the eight orders.
TEST(Hdr, EveryOrientationIsThePictureUpright) {
  const std::pair<const char*, std::array<int, 6>> orders[] = {
      {"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}}, {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}}, {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}},
      {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}}, {"+X 3 -Y 2", {1, 4, 2, 5, 3, 6}}, {"+X 3 +Y 2", {4, 1, 5, 2, 6, 3}},
      {"-X 3 -Y 2", {3, 6, 2, 5, 1, 4}}, {"-X 3 +Y 2", {6, 3, 5, 2, 4, 1}}};
  for (const auto& [sizes, stored] : orders) {
    Bytes pixels;
    for (const int value : stored) pixels.insert(pixels.end(), {static_cast<std::uint8_t>(value), 0, 0, 136});
    const LinearImage image = decodeImage(hdr(sizes, pixels), "file");
    ASSERT_EQ(image.size, (core::ImageSize{3, 2})) << sizes;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(image.values[3 * i], static_cast<float>(i + 1)) << sizes;
  }
}

TEST(Hdr, RefusesWhatItCannotShowAndSaysWhere) {
  const Bytes pixel{128, 128, 128, 129};
  EXPECT_THAT(decodeError(hdr("-Y 1 +X 1", pixel, "FORMAT=32-bit_rle_xyze\n")), HasSubstr("32-bit_rle_rgbe"));
  EXPECT_THAT(decodeError(hdr("-Y 1 +X 1", pixel, "EXPOSURE=0\n")), HasSubstr("EXPOSURE"));
  EXPECT_THAT(decodeError(hdr("-Y 1 +X 1", {255, 1, 1, 255}, "EXPOSURE=1e-20\n")), HasSubstr("too bright"));
  EXPECT_THAT(decodeError(hdr("-Y 1 -Y 1", pixel)), HasSubstr("of X and of Y"));
  EXPECT_THAT(decodeError(hdr("1 1", pixel)), HasSubstr("sizes"));
  EXPECT_THAT(decodeError(hdr("-Y 70000 +X 2", pixel)), HasSubstr("allowed are"));
  EXPECT_THAT(decodeError(hdr("-Y 9000 +X 9000", pixel)), HasSubstr("allowed are"));
  EXPECT_THAT(decodeError(hdr("-Y 2 +X 1", pixel)), HasSubstr("cut off"));
  EXPECT_THAT(decodeError(hdr("-Y 1 +X 2", {1, 1, 1, 2})), HasSubstr("repeats no pixel"));
  EXPECT_THAT(decodeError(hdr("-Y 1 +X 2", {9, 9, 9, 9, 1, 1, 1, 2})), HasSubstr("does not fit"));
  EXPECT_THAT(decodeError(hdr("-Y 1 +X 8", {2, 2, 0, 8, 137, 1})), HasSubstr("does not fit"));
}

}  // namespace
}  // namespace sluice::imageio::test
