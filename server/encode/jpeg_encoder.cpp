#include "jpeg_encoder.h"

#include <turbojpeg.h>

#include <string>

#include "encoded_frame.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::encode {

void JpegEncoder::Destroy::operator()(void* handle) const { tjDestroy(handle); }

JpegEncoder::JpegEncoder(int quality, bool fullChroma)
    : quality_(quality), fullChroma_(fullChroma), compressor_(tjInitCompress()) {
  SLUICE_CHECK(quality >= 1 && quality <= 100);
  if (!compressor_)
    throw core::EnvironmentError(std::string("cannot start the JPEG encoder: ") + tjGetErrorStr2(nullptr));
}

core::EncodedFrame JpegEncoder::encode(const core::Frame& frame) {
  core::EncodedFrame encoded = encodeTimed(frame, core::Codec::Jpeg, [&] {
    const auto [width, height] = frame.size;
    const int subsampling = fullChroma_ ? TJSAMP_444 : TJSAMP_420;
    const unsigned long worstCase = tjBufSize(width, height, subsampling);
    if (scratch_.size() < worstCase) scratch_.resize(worstCase);

    // With NOREALLOC the library writes into our buffer or fails; the worst case always fits.
    unsigned char* target = scratch_.data();
    unsigned long bytes = scratch_.size();
    constexpr int kTightRows = 0;
    if (tjCompress2(compressor_.get(), frame.pixels.data(), width, kTightRows, height, TJPF_RGBA, &target, &bytes,
                    subsampling, quality_, TJFLAG_NOREALLOC) != 0) {
      throw core::EnvironmentError(std::string("cannot encode a JPEG: ") + tjGetErrorStr2(compressor_.get()));
    }
    return std::vector<std::uint8_t>(target, target + bytes);
  });
  encoded.quality = quality_;
  return encoded;
}

bool JpegEncoder::retune(const EncoderSettings& settings) {
  if (settings.codec != core::Codec::Jpeg) return false;
  SLUICE_CHECK(settings.quality >= 1 && settings.quality <= 100);
  quality_ = settings.quality;
  fullChroma_ = settings.fullChroma;
  return true;
}

}  // namespace sluice::encode
