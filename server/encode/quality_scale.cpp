#include "quality_scale.h"

#include <array>
#include <cstddef>

#include "sluice/core/check.h"

namespace sluice::encode {

namespace {

constexpr std::array<int, 7> kQualities = {1, 20, 40, 60, 80, 90, 100};
using Scale = std::array<double, kQualities.size()>;
constexpr Scale kH264 = {45, 36, 31, 27, 23, 19, 12};
constexpr Scale kVp9 = {63, 52, 44, 38, 31, 24, 10};
constexpr Scale kAv1 = {63, 52, 44, 38, 31, 24, 10};

const Scale& scaleOf(core::Codec codec) {
  switch (codec) {
    case core::Codec::H264:
      return kH264;
    case core::Codec::Vp9:
      return kVp9;
    default:
      return kAv1;
  }
}

}  // namespace

double constantQuality(core::Codec codec, int quality) {
  SLUICE_CHECK(core::isVideo(codec) && quality >= 1 && quality <= 100);
  const Scale& scale = scaleOf(codec);
  std::size_t upper = 1;
  while (kQualities[upper] < quality) ++upper;
  const double share =
      static_cast<double>(quality - kQualities[upper - 1]) / (kQualities[upper] - kQualities[upper - 1]);
  return scale[upper - 1] + share * (scale[upper] - scale[upper - 1]);
}

}  // namespace sluice::encode
