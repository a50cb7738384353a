#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sluice/v1/session.pb.h"

namespace sluice::media {
class VideoDecoder;
}

namespace sluice::client {

/// A picture's pixels, rows from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::byte> rgba;  ///< 4·width·height bytes.
};

/// Decodes the frames of a stream, keeping its buffer from one to the next; of video, all of them in order, stills and
/// snapshots in between. For one thread at a time.
class FrameDecoder {
 public:
  FrameDecoder();
  ~FrameDecoder();

  /// Valid until the next call. Throws RequestError for a payload that is damaged, of a codec that was not asked for,
  /// or of another size than the frame says.
  const Picture& decode(const v1::Frame& frame);

 private:
  void decodeJpeg(const v1::Frame& frame);
  void decodePng(const v1::Frame& frame);
  void decodeVideo(const v1::Frame& frame);

  Picture picture_;
  std::unique_ptr<media::VideoDecoder> video_;  ///< Of `videoCodec_`; none before the first keyframe.
  v1::Codec videoCodec_ = v1::CODEC_UNSPECIFIED;
};

}  // namespace sluice::client
