// Video end to end: encoded here, decoded by libavcodec.
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "decode.h"
#include "sluice/encode/frame_encoder.h"
#include "sluice/media/video_decoder.h"

namespace sluice::encode::test {
namespace {

media::VideoCodec mediaCodec(core::Codec codec) {
  switch (codec) {
    case core::Codec::Vp9:
      return media::VideoCodec::Vp9;
    case core::Codec::Av1:
      return media::VideoCodec::Av1;
    default:
      return media::VideoCodec::H264;
  }
}

std::vector<std::uint8_t> decode(media::VideoDecoder& decoder, const core::EncodedFrame& encoded) {
  core::Frame frame;
  frame.size = encoded.size;
  const media::RgbaPicture& picture = decoder.decode(encoded.bytes, encoded.size.width, encoded.size.height);
  frame.pixels = picture.pixels;
  return rgbOf(frame);
}

/// The picture moved to the right, wrapping around.
core::Frame moved(const core::Frame& picture, int pixels) {
  core::Frame result = picture;
  const auto [width, height] = picture.size;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c) {
        result.pixels[4U * (y * width + x) + c] = picture.pixels[4U * (y * width + (x + pixels) % width) + c];
      }
    }
  }
  return result;
}

core::Frame plain(core::ImageSize size, std::array<std::uint8_t, 3> colour) {
  core::Frame frame;
  frame.size = size;
  for (int i = 0; i < size.width * size.height; ++i) {
    frame.pixels.insert(frame.pixels.end(), {colour[0], colour[1], colour[2], 255});
  }
  return frame;
}

class Video : public testing::TestWithParam<core::Codec> {
 protected:
  EncoderSettings settings(int quality = 85) const { return {.codec = GetParam(), .quality = quality}; }
};

TEST_P(Video, OneFrameInOneOutCloseToThePicture) {
  const auto encoder = makeEncoder(settings());
  media::VideoDecoder decoder(mediaCodec(GetParam()));
  const core::Frame picture = makePicture({640, 360});
  for (int k = 0; k < 6; ++k) {
    const core::Frame frame = moved(picture, 2 * k);
    const core::EncodedFrame encoded = encoder->encode(frame);
    EXPECT_EQ(encoded.codec, GetParam());
    EXPECT_EQ(encoded.keyframe, k == 0);
    EXPECT_EQ(encoded.decoder.empty(), k != 0);
    EXPECT_EQ(encoded.quality, 85);
    // The noise of ±4 on every pixel, each colour apart, is what 4:2:0 loses most of: 38 dB at best.
    EXPECT_GT(psnr(decode(decoder, encoded), rgbOf(frame)), 32.0) << "frame " << k;
  }
}

TEST_P(Video, KeyframeOnRequestStartsADecoder) {
  const auto encoder = makeEncoder(settings());
  const core::Frame picture = makePicture({320, 180});
  for (int k = 0; k < 3; ++k) encoder->encode(moved(picture, k));
  encoder->requestKeyframe();
  const core::EncodedFrame key = encoder->encode(picture);
  EXPECT_TRUE(key.keyframe);
  media::VideoDecoder decoder(mediaCodec(GetParam()));
  EXPECT_GT(psnr(decode(decoder, key), rgbOf(picture)), 32.0);
  const core::EncodedFrame next = encoder->encode(moved(picture, 1));
  EXPECT_FALSE(next.keyframe) << "one request, one keyframe";
  EXPECT_GT(psnr(decode(decoder, next), rgbOf(moved(picture, 1))), 32.0);
}

TEST_P(Video, TakesAnySizeAndChangesOfSizeInOneStream) {
  const auto encoder = makeEncoder(settings(95));
  media::VideoDecoder decoder(mediaCodec(GetParam()));
  for (const core::ImageSize size : {core::ImageSize{320, 180}, {641, 361}, {1, 1}, {2, 1}, {15, 17}, {320, 180}}) {
    const core::Frame frame = plain(size, {200, 60, 40});
    for (int k = 0; k < 2; ++k) {
      const core::EncodedFrame encoded = encoder->encode(frame);
      EXPECT_EQ(encoded.keyframe, k == 0);
      EXPECT_EQ(encoded.size, size);
      EXPECT_GT(psnr(decode(decoder, encoded), rgbOf(frame)), 36.0) << size.width << "x" << size.height;
    }
  }
}

TEST_P(Video, ColoursComeBackWithinAFewLevels) {
  for (const auto& colour : std::to_array<std::array<std::uint8_t, 3>>(
           {{0, 0, 0}, {255, 255, 255}, {128, 128, 128}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {30, 90, 160}})) {
    media::VideoDecoder decoder(mediaCodec(GetParam()));
    const core::Frame frame = plain({64, 64}, colour);
    const std::vector<std::uint8_t> rgb = decode(decoder, makeEncoder(settings(95))->encode(frame));
    // A level of Y' or Cr is up to two of a colour, and both are rounded, then quantised once more.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[3 * (64 * 32 + 32) + c], colour[c], 6) << "component " << c;
  }
}

TEST_P(Video, QualityBuysFidelityWithBytes) {
  const core::Frame picture = makePicture({320, 180});
  std::size_t bytes = 0;
  double fidelity = 0;
  for (const int quality : {20, 60, 95}) {
    media::VideoDecoder decoder(mediaCodec(GetParam()));
    const core::EncodedFrame encoded = makeEncoder(settings(quality))->encode(picture);
    const double now = psnr(decode(decoder, encoded), rgbOf(picture));
    EXPECT_GT(encoded.bytes.size(), bytes);
    EXPECT_GT(now, fidelity);
    bytes = encoded.bytes.size();
    fidelity = now;
  }
}

/// Kilobits of each of the first three seconds, at 30 frames a second.
std::array<double, 3> kilobitsOfSeconds(const EncoderSettings& settings) {
  const auto encoder = makeEncoder(settings);
  std::array<double, 3> kilobits{};
  std::uint32_t seed = 0;
  for (double& second : kilobits) {
    for (int k = 0; k < 30; ++k) {
      // New noise in every frame, which nothing predicts.
      second += 8.0 * static_cast<double>(encoder->encode(makePicture({640, 360}, ++seed)).bytes.size()) / 1000;
    }
  }
  return kilobits;
}

TEST_P(Video, KeepsBelowItsMostInEverySecond) {
  EncoderSettings bounded = settings(100);
  bounded.frameRate = 30;
  constexpr int kMost = 1000;
  for (const double second : kilobitsOfSeconds(bounded)) EXPECT_GT(second, 2 * kMost) << "needs no bound";
  bounded.kilobitsPerSecond = kMost;
  for (const double second : kilobitsOfSeconds(bounded)) EXPECT_LT(second, 1.1 * kMost);
}

TEST_P(Video, SpendsItsConstantRateOnceItKnowsThePicture) {
  EncoderSettings constant = settings();
  constant.kilobitsPerSecond = 2000;
  constant.constantBitRate = true;
  constant.frameRate = 30;
  const auto [first, second, third] = kilobitsOfSeconds(constant);
  // libvpx and libaom start from the coarsest quantiser, and find in the first second what such a picture takes.
  EXPECT_LT(first, 1.1 * constant.kilobitsPerSecond);
  EXPECT_NEAR(second, constant.kilobitsPerSecond, 0.1 * constant.kilobitsPerSecond);
  EXPECT_NEAR(third, constant.kilobitsPerSecond, 0.1 * constant.kilobitsPerSecond);
}

std::vector<core::Codec> videoCodecs() {
  std::vector<core::Codec> codecs;
  for (const core::Codec codec : availableCodecs()) {
    if (core::isVideo(codec)) codecs.push_back(codec);
  }
  return codecs;
}

INSTANTIATE_TEST_SUITE_P(Codecs, Video, testing::ValuesIn(videoCodecs()), [](const auto& instance) {
  switch (instance.param) {
    case core::Codec::Vp9:
      return "Vp9";
    case core::Codec::Av1:
      return "Av1";
    default:
      return "H264";
  }
});

TEST(VideoCodecs, AllThreeAreThereInTheOrderOfTheirBytes) {
  EXPECT_EQ(videoCodecs(), (std::vector{core::Codec::Av1, core::Codec::Vp9, core::Codec::H264}));
}

TEST(VideoCodecs, StreamsAreNamedAsWebCodecsNamesThem) {
  const core::Frame frame = makePicture({1280, 720});
  EXPECT_EQ(makeEncoder({.codec = core::Codec::H264})->encode(frame).decoder.substr(0, 5), "avc1.");
  EXPECT_EQ(makeEncoder({.codec = core::Codec::H264})->encode(frame).decoder.size(), 11U);
  EXPECT_EQ(makeEncoder({.codec = core::Codec::Vp9})->encode(frame).decoder, "vp09.00.31.08.00.01.01.01.00");
  const std::string av1 = makeEncoder({.codec = core::Codec::Av1})->encode(frame).decoder;
  EXPECT_EQ(av1.substr(0, 7), "av01.0.");
  EXPECT_EQ(av1.substr(9), "M.08");
}

TEST(H264, RetunesWithoutAKeyframe) {
  EncoderSettings settings{.codec = core::Codec::H264, .quality = 90, .kilobitsPerSecond = 8000, .frameRate = 30};
  const auto encoder = makeEncoder(settings);
  const auto bytesOf = [&](int first) {
    std::size_t bytes = 0;
    for (int k = first; k < first + 30; ++k) {
      const core::EncodedFrame encoded = encoder->encode(makePicture({320, 180}, k + 1));
      EXPECT_EQ(encoded.keyframe, k == 0);
      bytes += encoded.bytes.size();
    }
    return bytes;
  };
  bytesOf(0);
  const std::size_t wide = bytesOf(30);
  settings.kilobitsPerSecond = 1000;
  EXPECT_TRUE(encoder->retune(settings));
  bytesOf(60);
  constexpr double kSecondAt1000 = 125000;  // bytes
  EXPECT_GT(static_cast<double>(wide), 1.5 * kSecondAt1000);
  EXPECT_LT(static_cast<double>(bytesOf(90)), 1.15 * kSecondAt1000);
  settings.kilobitsPerSecond = 8000;
  settings.quality = 30;
  EXPECT_TRUE(encoder->retune(settings));
  EXPECT_EQ(encoder->encode(makePicture({320, 180})).quality, 30);
  settings.kilobitsPerSecond = 0;
  EXPECT_FALSE(encoder->retune(settings)) << "x264 cannot drop its buffer";
}

}  // namespace
}  // namespace sluice::encode::test
