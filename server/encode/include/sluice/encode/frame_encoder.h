#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sluice/core/frame.h"

namespace sluice::encode {

struct EncoderSettings {
  core::Codec codec = core::Codec::Jpeg;
  /// Quality of lossy codecs, 1..100.
  int quality = 85;
  /// JPEG: colour at full resolution (4:4:4) instead of half (4:2:0).
  bool fullChroma = false;
  /// Video: bits per second at most, averaged over a fraction of a second; 0: whatever `quality` takes.
  int kilobitsPerSecond = 0;
  /// Video: spend all of `kilobitsPerSecond`, whatever `quality` says.
  bool constantBitRate = false;
  /// Video: frames per second to share the bits among; > 0.
  double frameRate = 60;

  bool operator==(const EncoderSettings&) const = default;
};

/// Turns pictures into bytes. One encoder serves one stream of frames on one thread at a time: video codecs carry
/// state from frame to frame.
class FrameEncoder {
 public:
  virtual ~FrameEncoder() = default;

  /// The frame's tag with the stage "encode" added, and its bytes. The size may change from frame to frame.
  virtual core::EncodedFrame encode(const core::Frame& frame) = 0;

  /// The next frame will decode without any before it.
  virtual void requestKeyframe() {}

  /// Takes over other settings from the next frame on, without a keyframe where the codec can. False where it takes a
  /// new encoder; nothing has changed then.
  virtual bool retune(const EncoderSettings& /*settings*/) { return false; }
};

/// The codecs that this build can encode, those that need the fewest bytes first.
std::vector<core::Codec> availableCodecs();

std::unique_ptr<FrameEncoder> makeEncoder(const EncoderSettings& settings);

/// Writes a picture as a PNG file. Throws core::InputError that names the path where it cannot be written.
void writePng(const core::Frame& frame, const std::string& path);

}  // namespace sluice::encode
