#include "tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sluice/scene/scene.h"

namespace sluice::render {
namespace {

constexpr std::uint16_t kHalfOne = 0x3C00;
constexpr std::uint16_t kInfinity = 0x7C00;
constexpr std::uint16_t kNotANumber = 0x7E00;
constexpr std::uint16_t kMinusOne = 0xBC00;

std::vector<v1::Tone> everyOperator() {
  std::vector<v1::Tone> all(4);
  all[0].mutable_soft_clip();
  all[1].mutable_filmic();
  all[2].mutable_reinhard();
  all[3].mutable_clip();
  return all;
}

TEST(ToneCurve, RisesFromBlackAndNeverPassesWhite) {
  for (const v1::Tone& tone : everyOperator()) {
    EXPECT_NEAR(toneMapped(0.0F, tone), 0.0F, 1e-6) << tone.ShortDebugString();
    float before = 0;
    for (float radiance = 1e-4F; radiance < 1e5F; radiance *= 1.1F) {
      const float shown = toneMapped(radiance, tone);
      EXPECT_GE(shown, before) << tone.ShortDebugString() << radiance;
      EXPECT_LE(shown, 1.0F) << tone.ShortDebugString() << radiance;
      before = shown;
    }
    EXPECT_GT(before, 0.99F) << tone.ShortDebugString();
  }
}

TEST(ToneCurve, SoftClipIsLinearUpToItsKneeAndSmoothThere) {
  const v1::Tone tone;
  EXPECT_EQ(toneMapped(0.5F, tone), 0.5F);
  const float step = 1e-3F;
  const float below = (toneMapped(0.8F, tone) - toneMapped(0.8F - step, tone)) / step;
  const float above = (toneMapped(0.8F + step, tone) - toneMapped(0.8F, tone)) / step;
  EXPECT_NEAR(below, above, 0.01F);
}

TEST(ToneCurve, AStopDoublesTheLight) {
  for (v1::Tone tone : everyOperator()) {
    const float doubled = toneMapped(0.6F, tone);
    tone.set_exposure(1);
    EXPECT_NEAR(toneMapped(0.3F, tone), doubled, 1e-6F) << tone.ShortDebugString();
  }
}

TEST(ToneTable, IsTheCurveForEveryHalf) {
  v1::Tone tone;
  tone.mutable_clip();
  const ToneTable table(tone);
  // 1, ½, ¼ and one that is hardly any light.
  const std::vector<std::uint16_t> radiance{kHalfOne, 0x3800, 0x3400, kHalfOne, 0x0001, 0, kHalfOne, 0};
  std::vector<std::uint8_t> pixels(radiance.size());
  table.apply(radiance, pixels);
  const auto level = [](double linear) { return std::lround(255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055)); };
  EXPECT_EQ(pixels, (std::vector<std::uint8_t>{255, static_cast<std::uint8_t>(level(0.5)),
                                               static_cast<std::uint8_t>(level(0.25)), 255, 0, 0, 255, 255}));
}

TEST(ToneTable, ShowsNoLightForWhatIsNone) {
  const ToneTable table((v1::Tone()));
  const std::vector<std::uint16_t> radiance{kNotANumber, kMinusOne, kInfinity, 0};
  std::vector<std::uint8_t> pixels(radiance.size());
  table.apply(radiance, pixels);
  EXPECT_EQ(pixels, (std::vector<std::uint8_t>{0, 0, 255, 255}));
}

}  // namespace
}  // namespace sluice::render
