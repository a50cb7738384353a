#include "codec.h"

namespace sluice::stream {

v1::Codec toProto(core::Codec codec) {
  switch (codec) {
    case core::Codec::Jpeg:
      return v1::JPEG;
    case core::Codec::Png:
      return v1::PNG;
  }
  return v1::CODEC_UNSPECIFIED;
}

std::optional<core::Codec> fromProto(v1::Codec codec) {
  switch (codec) {
    case v1::JPEG:
      return core::Codec::Jpeg;
    case v1::PNG:
      return core::Codec::Png;
    default:
      return std::nullopt;
  }
}

}  // namespace sluice::stream
