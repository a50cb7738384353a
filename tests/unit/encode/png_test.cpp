#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "decode.h"
#include "sluice/core/input_error.h"
#include "sluice/encode/frame_encoder.h"

namespace sluice::encode::test {
namespace {

const EncoderSettings kPng{.codec = core::Codec::Png};

TEST(Png, RoundTripIsLosslessAtAnySize) {
  const auto encoder = makeEncoder(kPng);
  // One encoder for all: sizes change when a viewer resizes its window.
  for (const core::ImageSize size : {core::ImageSize{1, 1}, {2, 1}, {1, 3}, {17, 9}, {640, 480}, {333, 201}, {8, 8}}) {
    const core::Frame frame = makePicture(size);
    const Decoded decoded = decodePng(encoder->encode(frame).bytes);
    EXPECT_EQ(decoded.size, size);
    EXPECT_EQ(decoded.rgb, rgbOf(frame)) << size.width << "x" << size.height;
  }
}

TEST(Png, NoiseThatDoesNotCompressIsStillExact) {
  core::Frame frame = makePicture({256, 256});
  std::uint32_t state = 1;
  for (std::uint8_t& byte : frame.pixels) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(state >> 24U);
  }
  EXPECT_EQ(decodePng(makeEncoder(kPng)->encode(frame).bytes).rgb, rgbOf(frame));
}

TEST(Png, CarriesTheTagAndAddsTheEncodeStage) {
  core::Frame frame = makePicture({16, 16});
  frame.tag = {.snapshotSequence = 13, .simulationTime = 0.5, .still = true, .stages = {{"composite", 2.0}}};
  const core::EncodedFrame encoded = makeEncoder(kPng)->encode(frame);
  EXPECT_EQ(encoded.codec, core::Codec::Png);
  EXPECT_TRUE(encoded.keyframe);
  EXPECT_EQ(encoded.size, frame.size);
  EXPECT_EQ(encoded.tag.snapshotSequence, 13U);
  EXPECT_EQ(encoded.tag.simulationTime, 0.5);
  EXPECT_TRUE(encoded.tag.still);
  ASSERT_EQ(encoded.tag.stages.size(), 2U);
  EXPECT_EQ(encoded.tag.stages[0].name, "composite");
  EXPECT_EQ(encoded.tag.stages[1].name, "encode");
  EXPECT_GT(encoded.tag.stages[1].milliseconds, 0);
}

TEST(WritePng, FileHoldsThePicture) {
  const core::Frame frame = makePicture({31, 7});
  const std::string path = testing::TempDir() + "sluice_write_png.png";
  writePng(frame, path);
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(decodePng(bytes).rgb, rgbOf(frame));
  std::filesystem::remove(path);
}

TEST(WritePng, NamesThePathThatCannotBeWritten) {
  const std::string path = testing::TempDir() + "no_such_folder/picture.png";
  try {
    writePng(makePicture({4, 4}), path);
    FAIL() << "was written";
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.where(), path);
    EXPECT_EQ(error.problem(), "cannot be written: No such file or directory");
  }
}

}  // namespace
}  // namespace sluice::encode::test
