#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "sluice/core/input_error.h"
#include "sluice/imageio/image_file.h"

namespace sluice::imageio::test {

using Bytes = std::vector<std::uint8_t>;

/// A PNG of rows as libpng takes them (16 bits: most significant byte first). `colourType` is libpng's.
Bytes png(core::ImageSize size, int bitDepth, int colourType, const Bytes& rows, bool interlaced = false);

/// Red and blue, as a PNG with a palette of two and one bit a pixel.
Bytes palettePng(core::ImageSize size, const Bytes& rows);

Bytes jpeg(core::ImageSize size, const Bytes& rgb, bool progressive = false);

inline Bytes bytesOf(std::string_view text) { return {text.begin(), text.end()}; }

/// A Radiance picture: `sizes` is the line that tells them, `pixels` what follows.
inline Bytes hdr(const std::string& sizes, const Bytes& pixels, const std::string& lines = "FORMAT=32-bit_rle_rgbe\n") {
  Bytes bytes = bytesOf("#?RADIANCE\n" + lines + "\n" + sizes + "\n");
  bytes.insert(bytes.end(), pixels.begin(), pixels.end());
  return bytes;
}

/// A scanline of equal pixels, run-length encoded in the new way.
inline Bytes newScanline(std::size_t width, std::array<std::uint8_t, 4> pixel) {
  Bytes bytes{2, 2, static_cast<std::uint8_t>(width >> 8U), static_cast<std::uint8_t>(width & 255U)};
  for (const std::uint8_t component : pixel) {
    for (std::size_t left = width; left > 0;) {
      const std::size_t run = std::min<std::size_t>(left, 127);
      bytes.push_back(static_cast<std::uint8_t>(128 + run));
      bytes.push_back(component);
      left -= run;
    }
  }
  return bytes;
}

/// The message of the InputError that reading throws; empty, and a failure, where it throws none.
inline std::string decodeError(const Bytes& bytes) {
  try {
    decodeImage(bytes, "file");
  } catch (const core::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was read";
  return {};
}

}  // namespace sluice::imageio::test
