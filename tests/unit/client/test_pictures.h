#pragma once

#include <cstdint>
#include <string>

namespace sluice::client {

/// A picture of one colour (red, green, blue in 0..255), encoded.
std::string pngOf(int width, int height, std::uint32_t rgb);
std::string jpegOf(int width, int height, std::uint32_t rgb);

}  // namespace sluice::client
