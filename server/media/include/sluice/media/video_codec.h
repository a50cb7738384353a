#pragma once

#include <cstdint>

namespace sluice::media {

enum class VideoCodec : std::uint8_t { H264, Vp9, Av1 };

/// Whether this build can encode, decode and mux video: it was made with SLUICE_VIDEO. Without it everything of this
/// module throws core::EnvironmentError.
bool hasVideo();

}  // namespace sluice::media
