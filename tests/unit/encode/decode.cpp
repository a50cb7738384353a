#include "decode.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

#include <cmath>
#include <random>

namespace sluice::encode::test {

core::Frame makePicture(core::ImageSize size, std::uint32_t seed) {
  core::Frame frame;
  frame.size = size;
  frame.pixels.reserve(4U * size.width * size.height);
  std::mt19937 random(seed);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto noise = static_cast<int>(random() % 9U);
      const int edge = x > y ? 80 : 0;
      frame.pixels.push_back(static_cast<std::uint8_t>(100 * x / size.width + edge + noise));
      frame.pixels.push_back(static_cast<std::uint8_t>(150 * y / size.height + noise));
      frame.pixels.push_back(static_cast<std::uint8_t>(60 + edge + noise));
      frame.pixels.push_back(static_cast<std::uint8_t>(random()));
    }
  }
  return frame;
}

Decoded decodePng(std::span<const std::uint8_t> bytes) {
  Decoded decoded;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    ADD_FAILURE() << image.message;
    return decoded;
  }
  EXPECT_EQ(image.format & PNG_FORMAT_FLAG_ALPHA, 0U) << "the file has an alpha channel";
  image.format = PNG_FORMAT_RGB;
  decoded.size = {static_cast<int>(image.width), static_cast<int>(image.height)};
  decoded.rgb.resize(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, decoded.rgb.data(), 0, nullptr), 0) << image.message;
  return decoded;
}

Decoded decodeJpeg(std::span<const std::uint8_t> bytes, int expectedSubsampling) {
  Decoded decoded;
  const tjhandle handle = tjInitDecompress();
  int subsampling = 0;
  int colourSpace = 0;
  EXPECT_EQ(tjDecompressHeader3(handle, bytes.data(), bytes.size(), &decoded.size.width, &decoded.size.height,
                                &subsampling, &colourSpace),
            0);
  EXPECT_EQ(subsampling, expectedSubsampling);
  decoded.rgb.resize(3U * decoded.size.width * decoded.size.height);
  EXPECT_EQ(tjDecompress2(handle, bytes.data(), bytes.size(), decoded.rgb.data(), decoded.size.width, 0,
                          decoded.size.height, TJPF_RGB, 0),
            0);
  tjDestroy(handle);
  return decoded;
}

std::vector<std::uint8_t> rgbOf(const core::Frame& frame) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(frame.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < frame.pixels.size(); i += 4) {
    rgb.insert(rgb.end(), frame.pixels.begin() + static_cast<std::ptrdiff_t>(i),
               frame.pixels.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  return rgb;
}

double psnr(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += std::pow(static_cast<double>(a[i]) - b[i], 2);
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.size()) / squares);
}

}  // namespace sluice::encode::test
