#pragma once

#include <memory>
#include <string>

#include "sluice/core/frame.h"

namespace sluice::encode {

struct EncoderSettings {
  core::Codec codec = core::Codec::Jpeg;
  /// Quality of lossy codecs, 1..100.
  int quality = 85;

  bool operator==(const EncoderSettings&) const = default;
};

/// Turns pictures into bytes. One encoder serves one stream of frames on one thread at a time (later codecs carry
/// state from frame to frame).
class FrameEncoder {
 public:
  virtual ~FrameEncoder() = default;

  /// The frame's tag with the stage "encode" added, and its bytes. The size may change from frame to frame.
  virtual core::EncodedFrame encode(const core::Frame& frame) = 0;
};

std::unique_ptr<FrameEncoder> makeEncoder(const EncoderSettings& settings);

/// Writes a picture as a PNG file. Throws core::InputError that names the path where it cannot be written.
void writePng(const core::Frame& frame, const std::string& path);

}  // namespace sluice::encode
