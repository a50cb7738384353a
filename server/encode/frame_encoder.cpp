#include "sluice/encode/frame_encoder.h"

#include "jpeg_encoder.h"
#include "png_encoder.h"
#include "video_encoder.h"

namespace sluice::encode {

std::unique_ptr<FrameEncoder> makeEncoder(const EncoderSettings& settings) {
  switch (settings.codec) {
    case core::Codec::Jpeg:
      return std::make_unique<JpegEncoder>(settings.quality, settings.fullChroma);
    case core::Codec::Png:
      return std::make_unique<PngEncoder>();
    case core::Codec::H264:
    case core::Codec::Vp9:
    case core::Codec::Av1:
      break;
  }
  return makeVideoEncoder(settings);
}

std::vector<core::Codec> availableCodecs() {
  std::vector<core::Codec> codecs = availableVideoCodecs();
  codecs.insert(codecs.end(), {core::Codec::Jpeg, core::Codec::Png});
  return codecs;
}

}  // namespace sluice::encode
