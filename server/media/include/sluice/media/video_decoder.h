#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sluice/media/video_codec.h"

namespace sluice::media {

/// 8-bit RGBA, rows from the top without padding.
struct RgbaPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< 4·width·height bytes; alpha is 255.
};

/// Decodes a low-delay stream of 4:2:0 pictures, limited range, matrix of BT.709, keeping its state from packet to
/// packet: one packet in, its picture out. For one thread at a time.
class VideoDecoder {
 public:
  /// Throws core::EnvironmentError where this build has no decoder for `codec`.
  explicit VideoDecoder(VideoCodec codec);
  ~VideoDecoder();
  VideoDecoder(VideoDecoder&&) noexcept;
  VideoDecoder& operator=(VideoDecoder&&) noexcept;

  /// The picture of a packet, cut to `width`×`height`: the stream's own size, or one column or row less where the codec
  /// codes even sizes alone. The result is valid until the next call. Throws core::InputError for a packet that is
  /// damaged, that shows no picture (a first one that is no keyframe), or whose picture is of another size.
  const RgbaPicture& decode(std::span<const std::uint8_t> packet, int width, int height);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sluice::media
