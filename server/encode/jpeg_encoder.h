#pragma once

#include <memory>
#include <vector>

#include "sluice/encode/frame_encoder.h"

namespace sluice::encode {

/// JPEG by libjpeg-turbo, straight from RGBA (alpha is left out), chroma at half (4:2:0) or full
/// resolution (4:4:4).
class JpegEncoder final : public FrameEncoder {
 public:
  /// `quality` is 1..100.
  JpegEncoder(int quality, bool fullChroma);

  core::EncodedFrame encode(const core::Frame& frame) override;
  /// A JPEG stands alone, so that every setting of one can change.
  bool retune(const EncoderSettings& settings) override;

 private:
  struct Destroy {
    void operator()(void* handle) const;
  };

  int quality_;
  bool fullChroma_;
  std::unique_ptr<void, Destroy> compressor_;
  std::vector<unsigned char> scratch_;  // As large as the worst case of the largest frame so far.
};

}  // namespace sluice::encode
