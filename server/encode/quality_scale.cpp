#include "quality_scale.h"

#include <array>
#include <cstddef>

#include "sluice/core/check.h"

namespace sluice::encode {

namespace {

constexpr std::array<int, 7> kQualities = {1, 20, 40, 60, 80, 90, 100};
using Scale = std::array<double, kQualities.size()>;
constexpr Scale kH264 = {45, 36, 31, 27, 23, 19, 12};
// Between what brings dam_break and what brings corridor_flood to x264's fidelity; see docs/codecs.md.
constexpr Scale kVp9 = {63, 63, 53, 44, 36, 28, 13};
constexpr Scale kAv1 = {63, 61, 51, 41, 33, 25, 11};

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
