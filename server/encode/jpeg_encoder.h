#pragma once

#include <memory>
#include <vector>

#include "sluice/encode/frame_encoder.h"

namespace sluice::encode {

/// JPEG by libjpeg-turbo, straight from RGBA (alpha is left out), chroma at half resolution (4:2:0).
class JpegEncoder final : public FrameEncoder {
 public:
  /// `quality` is 1..100.
  explicit JpegEncoder(int quality);

  core::EncodedFrame encode(const core::Frame& frame) override;

 private:
  struct Destroy {
    void operator()(void* handle) const;
  };

  int quality_;
  std::unique_ptr<void, Destroy> compressor_;
  std::vector<unsigned char> scratch_;  // As large as the worst case of the largest frame so far.
};

}  // namespace sluice::encode
