// What is cut off, altered or made up: every reader answers with one InputError, in one line, or with finite light.
#include <cmath>
#include <filesystem>
#include <random>

#include <gmock/gmock.h>
#include <png.h>

#include "write_images.h"

namespace sluice::imageio::test {
namespace {

enum class Kind : std::uint8_t { Png, DeepPng, InterlacedPng, Jpeg, ProgressiveJpeg, FlatHdr, OldHdr, NewHdr };

constexpr Kind kKinds[] = {Kind::Png,    Kind::DeepPng, Kind::InterlacedPng,   Kind::FlatHdr,
                           Kind::OldHdr, Kind::Jpeg,    Kind::ProgressiveJpeg, Kind::NewHdr};

Bytes noise(std::size_t count) {
  std::mt19937 random(5);
  Bytes bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

Bytes sample(Kind kind) {
  switch (kind) {
    case Kind::Png:
      return png({6, 4}, 8, PNG_COLOR_TYPE_RGB, noise(72));
    case Kind::DeepPng:
      return png({6, 4}, 16, PNG_COLOR_TYPE_RGB_ALPHA, noise(192));
    case Kind::InterlacedPng:
      return png({6, 4}, 8, PNG_COLOR_TYPE_GRAY, noise(24), true);
    case Kind::Jpeg:
      return jpeg({9, 9}, noise(243));
    case Kind::ProgressiveJpeg:
      return jpeg({9, 9}, noise(243), true);
    case Kind::FlatHdr:
      return hdr("-Y 2 +X 3", noise(24));
    case Kind::OldHdr:
      return hdr("-Y 1 +X 9", {9, 9, 9, 130, 1, 1, 1, 7, 4, 4, 4, 120});
    case Kind::NewHdr: {
      Bytes lines = newScanline(20, {200, 100, 50, 131});
      const Bytes second = newScanline(20, {20, 10, 5, 100});
      lines.insert(lines.end(), second.begin(), second.end());
      return hdr("-Y 2 +X 20", lines);
    }
  }
  return {};
}

class HostilePicture : public testing::TestWithParam<Kind> {};

void expectLightOrInputError(const Bytes& bytes) {
  try {
    const LinearImage image = decodeImage(bytes, "file");
    ASSERT_EQ(image.values.size(),
              3 * static_cast<std::size_t>(image.size.width) * static_cast<std::size_t>(image.size.height));
    for (const float value : image.values) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    ASSERT_TRUE(message.starts_with("file")) << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_P(HostilePicture, CutOffAtEveryLengthIsRefused) {
  const Bytes whole = sample(GetParam());
  EXPECT_NO_THROW(decodeImage(whole, "file"));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THROW(decodeImage(cut, "file"), core::InputError) << length << " of " << whole.size();
  }
}

TEST_P(HostilePicture, EveryByteChanged) {
  const Bytes whole = sample(GetParam());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff, 0x39, 0x2d}) {
      Bytes changed = whole;
      changed[i] = static_cast<std::uint8_t>(value);
      expectLightOrInputError(changed);
    }
  }
}

TEST_P(HostilePicture, RandomBytesAfterAGoodStart) {
  const Bytes whole = sample(GetParam());
  std::mt19937 random(1);
  for (int round = 0; round < 1000; ++round) {
    Bytes bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(random() % whole.size()));
    for (std::size_t extra = random() % 64; extra > 0; --extra) bytes.push_back(static_cast<std::uint8_t>(random()));
    expectLightOrInputError(bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, HostilePicture, testing::ValuesIn(kKinds));

TEST(ImageFile, WhatIsNoPictureIsNamed) {
  EXPECT_THAT(decodeError(bytesOf("GIF89a")), testing::HasSubstr("file: is no picture that is known"));
  EXPECT_THAT(decodeError({}), testing::HasSubstr("is no picture that is known"));
  const auto readError = [](const std::filesystem::path& file) {
    try {
      readImage(file);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(readError("nowhere.hdr"), "nowhere.hdr: no such file");
  EXPECT_THAT(readError(std::filesystem::temp_directory_path()), testing::HasSubstr("is not a file"));
}

}  // namespace
}  // namespace sluice::imageio::test
