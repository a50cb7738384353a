#include "sluice/stream/codec.h"

namespace sluice::stream {

v1::Codec toProto(core::Codec codec) {
  switch (codec) {
    case core::Codec::Jpeg:
      return v1::JPEG;
    case core::Codec::Png:
      return v1::PNG;
    case core::Codec::H264:
      return v1::H264;
    case core::Codec::Vp9:
      return v1::VP9;
    case core::Codec::Av1:
      return v1::AV1;
  }
  return v1::CODEC_UNSPECIFIED;
}

std::optional<core::Codec> fromProto(v1::Codec codec) {
  switch (codec) {
    case v1::JPEG:
      return core::Codec::Jpeg;
    case v1::PNG:
      return core::Codec::Png;
    case v1::H264:
      return core::Codec::H264;
    case v1::VP9:
      return core::Codec::Vp9;
    case v1::AV1:
      return core::Codec::Av1;
    default:
      return std::nullopt;
  }
}

}  // namespace sluice::stream
