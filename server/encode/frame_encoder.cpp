#include "sluice/encode/frame_encoder.h"

#include "jpeg_encoder.h"
#include "png_encoder.h"
#include "sluice/core/check.h"

namespace sluice::encode {

std::unique_ptr<FrameEncoder> makeEncoder(const EncoderSettings& settings) {
  switch (settings.codec) {
    case core::Codec::Jpeg:
      return std::make_unique<JpegEncoder>(settings.quality);
    case core::Codec::Png:
      return std::make_unique<PngEncoder>();
    default:
      break;
  }
  core::checkFailed(__FILE__, __LINE__, "codec is known", "");
}

std::vector<core::Codec> availableCodecs() { return {core::Codec::Jpeg, core::Codec::Png}; }

}  // namespace sluice::encode
