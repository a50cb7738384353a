// A build without SLUICE_VIDEO.
#include "sluice/core/input_error.h"
#include "video_encoder.h"

namespace sluice::encode {

std::vector<core::Codec> availableVideoCodecs() { return {}; }

std::unique_ptr<FrameEncoder> makeVideoEncoder(const EncoderSettings&) {
  throw core::EnvironmentError("this program was built without video (SLUICE_VIDEO)");
}

}  // namespace sluice::encode
