#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sluice/encode/frame_encoder.h"

namespace sluice::encode {

/// Video codecs that this build can encode on this machine, those that need the fewest bytes first.
std::vector<core::Codec> availableVideoCodecs();

/// An encoder of H.264 (Annex B), VP9 or AV1: one frame in, one packet out, keyframes only at the start, on request and
/// where the size changes. Throws core::EnvironmentError where no encoder of the codec starts.
std::unique_ptr<FrameEncoder> makeVideoEncoder(const EncoderSettings& settings);

}  // namespace sluice::encode
