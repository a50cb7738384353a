#pragma once

#include <span>

#include "sluice/core/frame.h"
#include "sluice/encode/frame_encoder.h"
#include "sluice/media/libav.h"

namespace sluice::encode {

/// One of FFmpeg's encoders and how it is set up for a stream without delay: no frame looks ahead, none is reordered,
/// keyframes come on request alone.
struct VideoBackend {
  core::Codec codec;
  const char* encoder;  ///< FFmpeg's name.
  bool evenSizes;       ///< Codes even widths and heights alone.
  /// Sets the options of a context whose size and colours are set. The stream's nominal rate is settings.frameRate.
  void (*configure)(AVCodecContext& context, const EncoderSettings& settings);
  /// Takes other settings while the stream goes on; null where the encoder cannot. False where it cannot take these.
  bool (*retune)(AVCodecContext& context, const EncoderSettings& present, const EncoderSettings& wanted,
                 double nominalRate);
};

/// In the order in which they are tried: hardware before software.
std::span<const VideoBackend> videoBackends();

}  // namespace sluice::encode
