#include "sluice/client/frame_decoder.h"

#include <gtest/gtest.h>

#include "sluice/client/failure.h"
#include "test_pictures.h"

namespace sluice::client {
namespace {

constexpr std::uint32_t kColour = 0x3060C0;

v1::Frame frame(v1::Codec codec, std::string payload) {
  v1::Frame result;
  result.set_codec(codec);
  result.set_width(24);
  result.set_height(16);
  result.set_payload(std::move(payload));
  return result;
}

void expectColour(const Picture& picture, int tolerance) {
  ASSERT_EQ(picture.width, 24);
  ASSERT_EQ(picture.height, 16);
  ASSERT_EQ(picture.rgba.size(), 24U * 16U * 4U);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    EXPECT_NEAR(std::to_integer<int>(picture.rgba[i]), 0x30, tolerance);
    EXPECT_NEAR(std::to_integer<int>(picture.rgba[i + 1]), 0x60, tolerance);
    EXPECT_NEAR(std::to_integer<int>(picture.rgba[i + 2]), 0xC0, tolerance);
    EXPECT_EQ(std::to_integer<int>(picture.rgba[i + 3]), 255);
  }
}

TEST(FrameDecoder, GivesThePixelsOfPng) {
  FrameDecoder decoder;
  expectColour(decoder.decode(frame(v1::PNG, pngOf(24, 16, kColour))), 0);
}

TEST(FrameDecoder, GivesThePixelsOfJpeg) {
  FrameDecoder decoder;
  // Rounding to YCbCr and back costs at most two levels.
  expectColour(decoder.decode(frame(v1::JPEG, jpegOf(24, 16, kColour))), 2);
}

TEST(FrameDecoder, RefusesAnotherSizeThanTheHeaderSays) {
  FrameDecoder decoder;
  EXPECT_THROW(decoder.decode(frame(v1::PNG, pngOf(16, 24, kColour))), RequestError);
  EXPECT_THROW(decoder.decode(frame(v1::JPEG, jpegOf(16, 24, kColour))), RequestError);
}

TEST(FrameDecoder, RefusesDamageAndGoesOn) {
  FrameDecoder decoder;
  for (const v1::Codec codec : {v1::PNG, v1::JPEG}) {
    const std::string good = codec == v1::PNG ? pngOf(24, 16, kColour) : jpegOf(24, 16, kColour);
    EXPECT_THROW(decoder.decode(frame(codec, "")), RequestError);
    EXPECT_THROW(decoder.decode(frame(codec, "neither of them")), RequestError);
    EXPECT_THROW(decoder.decode(frame(codec, good.substr(0, good.size() / 2))), RequestError);
    expectColour(decoder.decode(frame(codec, good)), 2);
  }
}

TEST(FrameDecoder, RefusesCodecsItDoesNotKnow) {
  FrameDecoder decoder;
  EXPECT_THROW(decoder.decode(frame(v1::CODEC_UNSPECIFIED, "")), RequestError);
}

}  // namespace
}  // namespace sluice::client
