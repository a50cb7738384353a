#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "sluice/imageio/image_file.h"

namespace sluice::imageio {

// One reader per format. All throw core::InputError located at `name`.

LinearImage decodePng(std::span<const std::uint8_t> bytes, const std::string& name);
LinearImage decodeJpeg(std::span<const std::uint8_t> bytes, const std::string& name);
LinearImage decodeHdr(std::span<const std::uint8_t> bytes, const std::string& name);

/// Throws unless a picture of this size is one that is read.
void checkSize(std::uint64_t width, std::uint64_t height, const std::string& name);

}  // namespace sluice::imageio
