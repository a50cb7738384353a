#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sluice/core/camera.h"

namespace sluice::imageio {

/// A picture of linear light: red, green and blue interleaved, finite and at least 0, rows from the top down.
struct LinearImage {
  core::ImageSize size;
  std::vector<float> values;  ///< 3·width·height.
};

/// Pixels of the largest picture that is read: 8192x4096, 400 MB once it is linear light.
inline constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 25U;

/// Reads a PNG (any kind; values are taken as sRGB, alpha is dropped), a JPEG (likewise), or a Radiance picture of RGBE
/// pixels, whichever the bytes say that they are. Throws core::InputError, located at `name`, for anything else, for
/// what is cut off or damaged, and for more than kMostPixels; memory is taken only for what the bytes can hold.
LinearImage decodeImage(std::span<const std::uint8_t> bytes, const std::string& name);

/// The same from a file.
LinearImage readImage(const std::filesystem::path& file);

}  // namespace sluice::imageio
