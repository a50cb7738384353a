#include <gtest/gtest.h>
#include <turbojpeg.h>

#include "decode.h"
#include "sluice/encode/frame_encoder.h"

namespace sluice::encode::test {
namespace {

core::EncodedFrame encodeAt(int quality, const core::Frame& frame) {
  return makeEncoder({.codec = core::Codec::Jpeg, .quality = quality})->encode(frame);
}

TEST(Jpeg, StaysCloseToThePicture) {
  const core::Frame frame = makePicture({640, 360});
  const core::EncodedFrame encoded = encodeAt(85, frame);
  EXPECT_EQ(encoded.codec, core::Codec::Jpeg);
  const Decoded decoded = decodeJpeg(encoded.bytes);
  EXPECT_EQ(decoded.size, frame.size);
  // Uniform noise of ±4 has a deviation of 2.6, which alone is 40 dB; quality 85 is to lose no more than about that.
  EXPECT_GT(psnr(decoded.rgb, rgbOf(frame)), 35.0);
}

TEST(Jpeg, QualityBuysFidelityWithBytes) {
  const core::Frame frame = makePicture({320, 240});
  const core::EncodedFrame low = encodeAt(20, frame);
  const core::EncodedFrame high = encodeAt(95, frame);
  EXPECT_LT(low.bytes.size(), high.bytes.size());
  const std::vector<std::uint8_t> exact = rgbOf(frame);
  EXPECT_LT(psnr(decodeJpeg(low.bytes).rgb, exact), psnr(decodeJpeg(high.bytes).rgb, exact));
}

TEST(Jpeg, FullChromaKeepsColoursThatChangeFromPixelToPixel) {
  core::Frame frame;
  frame.size = {64, 64};
  for (int i = 0; i < 64 * 64; ++i) {
    const bool red = i % 2 == 0;
    for (const int value : {red ? 220 : 20, 20, red ? 20 : 220, 255}) {
      frame.pixels.push_back(static_cast<std::uint8_t>(value));
    }
  }
  const EncoderSettings half{.codec = core::Codec::Jpeg, .quality = 90};
  EncoderSettings full = half;
  full.fullChroma = true;
  const auto encoder = makeEncoder(half);
  const double before = psnr(decodeJpeg(encoder->encode(frame).bytes).rgb, rgbOf(frame));
  EXPECT_TRUE(encoder->retune(full));
  const double after = psnr(decodeJpeg(encoder->encode(frame).bytes, TJSAMP_444).rgb, rgbOf(frame));
  EXPECT_GT(after, before + 6);
}

TEST(Jpeg, TakesAnySizeAndChangesOfSize) {
  const auto encoder = makeEncoder({.codec = core::Codec::Jpeg, .quality = 90});
  for (const core::ImageSize size :
       {core::ImageSize{1, 1}, {2, 1}, {1, 3}, {15, 17}, {640, 480}, {333, 201}, {16, 16}}) {
    const Decoded decoded = decodeJpeg(encoder->encode(makePicture(size)).bytes);
    EXPECT_EQ(decoded.size, size);
  }
}

TEST(Jpeg, SameFrameGivesSameBytesWhateverCameBefore) {
  const core::Frame frame = makePicture({64, 48});
  const auto encoder = makeEncoder({.codec = core::Codec::Jpeg, .quality = 85});
  encoder->encode(makePicture({200, 100}, 2));
  EXPECT_EQ(encoder->encode(frame).bytes, encodeAt(85, frame).bytes);
}

TEST(Jpeg, RowsRunFromTheTopDownAndColoursKeepTheirOrder) {
  core::Frame frame;
  frame.size = {16, 32};
  // Red above blue.
  for (int i = 0; i < 16 * 32; ++i) {
    const bool top = i < 16 * 16;
    for (const int value : {top ? 255 : 0, 0, top ? 0 : 255, 255}) {
      frame.pixels.push_back(static_cast<std::uint8_t>(value));
    }
  }
  const Decoded decoded = decodeJpeg(encodeAt(95, frame).bytes);
  ASSERT_EQ(decoded.rgb.size(), 3U * 16 * 32);
  EXPECT_GT(decoded.rgb[0], 200);
  EXPECT_LT(decoded.rgb[2], 50);
  EXPECT_LT(decoded.rgb[decoded.rgb.size() - 3], 50);
  EXPECT_GT(decoded.rgb[decoded.rgb.size() - 1], 200);
}

}  // namespace
}  // namespace sluice::encode::test
