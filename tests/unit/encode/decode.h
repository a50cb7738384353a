#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sluice/core/frame.h"

namespace sluice::encode::test {

/// A picture with gradients, an edge and a little seeded noise: neither trivial nor impossible to compress. Its alpha
/// is no constant, so that an encoder that lets it through shows.
core::Frame makePicture(core::ImageSize size, std::uint32_t seed = 1);

struct Decoded {
  core::ImageSize size;
  std::vector<std::uint8_t> rgb;  ///< 3·width·height bytes.
};

Decoded decodePng(std::span<const std::uint8_t> bytes);
/// `subsampling`, TJSAMP_…, is what the file is expected to have; 4:2:0 unless said.
Decoded decodeJpeg(std::span<const std::uint8_t> bytes, int subsampling = 2);

/// The colours of a frame without its alpha.
std::vector<std::uint8_t> rgbOf(const core::Frame& frame);

/// Peak signal-to-noise ratio over all components, dB; infinite for equal pictures.
double psnr(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

}  // namespace sluice::encode::test
