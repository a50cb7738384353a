#pragma once

#include <cstdint>
#include <vector>

#include "sluice/encode/frame_encoder.h"

namespace sluice::encode {

/// Lossless PNG, 8-bit RGB (alpha is left out), tagged as sRGB. Tuned for speed: zlib level 1 behind the "sub" filter,
/// since level 6 takes seven times as long and saves a tenth of the bytes.
class PngEncoder final : public FrameEncoder {
 public:
  core::EncodedFrame encode(const core::Frame& frame) override;
};

/// The bytes of a PNG file that shows `frame`.
std::vector<std::uint8_t> toPng(const core::Frame& frame);

}  // namespace sluice::encode
