#include <gmock/gmock.h>
#include <png.h>
#include <zlib.h>

#include "srgb.h"
#include "write_images.h"

namespace sluice::imageio::test {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::FloatNear;
using ::testing::HasSubstr;

float linear(int value) { return linearOfSrgb(static_cast<float>(value) / 255.0F); }

TEST(Srgb, IsLinearLightByTheStandard) {
  EXPECT_EQ(linearOfSrgb(0.0F), 0.0F);
  EXPECT_FLOAT_EQ(linearOfSrgb(1.0F), 1.0F);
  EXPECT_NEAR(linearOfSrgb(0.5F), 0.2140411F, 1e-6F);
  EXPECT_NEAR(linearOfSrgb(0.04045F), 0.0031308F, 1e-6F);
}

TEST(Png, ColoursComeInRowsFromTheTop) {
  const LinearImage image = decodeImage(png({1, 2}, 8, PNG_COLOR_TYPE_RGB, {255, 0, 128, 10, 20, 30}), "file");
  EXPECT_EQ(image.size, (core::ImageSize{1, 2}));
  EXPECT_THAT(image.values, ElementsAre(FloatEq(1.0F), 0.0F, FloatEq(linear(128)), FloatEq(linear(10)),
                                        FloatEq(linear(20)), FloatEq(linear(30))));
}

TEST(Png, GreyIsAColourToo) {
  const LinearImage image = decodeImage(png({1, 1}, 8, PNG_COLOR_TYPE_GRAY, {77}), "file");
  EXPECT_THAT(image.values, ElementsAre(FloatEq(linear(77)), FloatEq(linear(77)), FloatEq(linear(77))));
}

TEST(Png, FewBitsSpanTheWholeRange) {
  // 2 bits a pixel: 0, 1, 2, 3.
  const LinearImage image = decodeImage(png({4, 1}, 2, PNG_COLOR_TYPE_GRAY, {0b00011011}), "file");
  EXPECT_FLOAT_EQ(image.values[0], 0.0F);
  EXPECT_FLOAT_EQ(image.values[3], linear(85));
  EXPECT_FLOAT_EQ(image.values[9], 1.0F);
}

TEST(Png, AlphaIsDropped) {
  const LinearImage rgb = decodeImage(png({1, 1}, 8, PNG_COLOR_TYPE_RGB_ALPHA, {10, 20, 30, 0}), "file");
  EXPECT_THAT(rgb.values, ElementsAre(FloatEq(linear(10)), FloatEq(linear(20)), FloatEq(linear(30))));
  const LinearImage grey = decodeImage(png({1, 1}, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {40, 7}), "file");
  EXPECT_THAT(grey.values, ElementsAre(FloatEq(linear(40)), FloatEq(linear(40)), FloatEq(linear(40))));
}

TEST(Png, SixteenBitsKeepWhatEightCannot) {
  const LinearImage image =
      decodeImage(png({1, 1}, 16, PNG_COLOR_TYPE_RGB, {0x80, 0x01, 0x80, 0x40, 0xff, 0xff}), "file");
  EXPECT_THAT(image.values, ElementsAre(FloatNear(linearOfSrgb(0x8001 / 65535.0F), 1e-6F),
                                        FloatNear(linearOfSrgb(0x8040 / 65535.0F), 1e-6F), FloatEq(1.0F)));
  EXPECT_LT(image.values[0], image.values[1]);
}

TEST(Png, PalettesAreColours) {
  const LinearImage image = decodeImage(palettePng({2, 1}, {0b01000000}), "file");
  EXPECT_THAT(image.values, ElementsAre(1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F));
}

TEST(Png, InterlacedIsTheSamePicture) {
  Bytes rows;
  for (int i = 0; i < 9 * 7 * 3; ++i) rows.push_back(static_cast<std::uint8_t>(i));
  const auto values = [&](bool interlaced) {
    return decodeImage(png({9, 7}, 8, PNG_COLOR_TYPE_RGB, rows, interlaced), "file").values;
  };
  EXPECT_EQ(values(true), values(false));
}

TEST(Png, ClaimsOfMoreThanTheFileCanHoldTakeNoMemory) {
  Bytes bytes = png({1, 1}, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3});
  // Width and height stand at byte 16, their checksum, over name and fields, at 29.
  bytes[18] = 0x10;
  bytes[22] = 0x10;
  EXPECT_THAT(decodeError(bytes), HasSubstr("file: is no PNG that can be read"));  // The checksum tells.

  uLong crc = crc32(0, bytes.data() + 12, 17);
  for (int i = 0; i < 4; ++i) bytes[29 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
  EXPECT_THAT(decodeError(bytes), HasSubstr("4097x4097 pixels cannot be in"));

  bytes[17] = 1;
  bytes[21] = 1;
  crc = crc32(0, bytes.data() + 12, 17);
  for (int i = 0; i < 4; ++i) bytes[29 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
  EXPECT_THAT(decodeError(bytes), HasSubstr("allowed are"));
}

}  // namespace
}  // namespace sluice::imageio::test
