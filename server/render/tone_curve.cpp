#include "tone_curve.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "sluice/core/check.h"

namespace sluice::render {

namespace {

float filmic(float radiance) {
  // Narkowicz 2015, a fit to the ACES reference curve.
  const float x = 0.6F * radiance;
  return std::clamp(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
}

float softClip(float radiance) {
  constexpr float kKnee = 0.8F;
  if (radiance <= kKnee) return radiance;
  return kKnee + (1.0F - kKnee) * (1.0F - std::exp(-(radiance - kKnee) / (1.0F - kKnee)));
}

}  // namespace

float toneMapped(float radiance, const v1::Tone& tone) {
  // Far beyond what any operator tells from white, and small enough for its square.
  constexpr float kWhite = 1e6F;
  const float exposed = std::min(radiance * std::exp2(static_cast<float>(tone.exposure())), kWhite);
  switch (tone.operator_case()) {
    case v1::Tone::kFilmic:
      return filmic(exposed);
    case v1::Tone::kReinhard:
      return exposed / (1.0F + exposed);
    case v1::Tone::kClip:
      return std::min(exposed, 1.0F);
    default:
      return softClip(exposed);
  }
}

float encodeSrgb(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

ToneTable::ToneTable(const v1::Tone& tone) {
  for (std::size_t bits = 0; bits < levels_.size(); ++bits) {
    const float radiance =
        Eigen::half_impl::half_to_float(Eigen::half_impl::raw_uint16_to_half(static_cast<std::uint16_t>(bits)));
    const float shown = radiance > 0.0F ? encodeSrgb(toneMapped(radiance, tone)) : 0.0F;
    levels_[bits] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(shown, 0.0F, 1.0F)));
  }
}

void ToneTable::apply(std::span<const std::uint16_t> radiance, std::span<std::uint8_t> pixels) const {
  SLUICE_CHECK_EQ(radiance.size(), pixels.size());
  const auto count = static_cast<std::ptrdiff_t>(pixels.size() / 4);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const std::uint16_t* const in = radiance.data() + 4 * i;
    std::uint8_t* const out = pixels.data() + 4 * i;
    out[0] = levels_[in[0]];
    out[1] = levels_[in[1]];
    out[2] = levels_[in[2]];
    out[3] = 255;
  }
}

}  // namespace sluice::render
