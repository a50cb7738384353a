// Palettes: their published ends, even rises in lightness, and what is beyond their ends.
#include "palette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tone_curve.h"

namespace sluice::render {
namespace {

using v1::ColourMap;

struct Ends {
  ColourMap::PaletteCase palette;
  Eigen::Vector3f first;  ///< Of 255.
  Eigen::Vector3f last;
};

class Palette : public ::testing::TestWithParam<Ends> {};

TEST_P(Palette, BeginsAndEndsAsPublished) {
  EXPECT_LT((255 * paletteColour(GetParam().palette, 0) - GetParam().first).norm(), 0.01F);
  EXPECT_LT((255 * paletteColour(GetParam().palette, 1) - GetParam().last).norm(), 0.01F);
}

TEST_P(Palette, IsThatOfItsEndsBeyondThem) {
  EXPECT_EQ(paletteColour(GetParam().palette, -3), paletteColour(GetParam().palette, 0));
  EXPECT_EQ(paletteColour(GetParam().palette, 1.5F), paletteColour(GetParam().palette, 1));
}

TEST_P(Palette, HasNoSteps) {
  // The steepest is turbo, which goes through most of the colours there are.
  for (int i = 0; i < 255; ++i) {
    const auto colour = [&](int k) { return paletteColour(GetParam().palette, static_cast<float>(k) / 255.0F); };
    EXPECT_LT((colour(i + 1) - colour(i)).cwiseAbs().maxCoeff(), 12.0F / 255.0F) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Palette,
                         ::testing::Values(Ends{ColourMap::kViridis, {68, 1, 84}, {253, 231, 37}},
                                           Ends{ColourMap::kMagma, {0, 0, 4}, {252, 253, 191}},
                                           Ends{ColourMap::kCividis, {0, 32, 81}, {253, 234, 69}},
                                           Ends{ColourMap::kCoolWarm, {59, 76, 192}, {180, 4, 38}},
                                           Ends{ColourMap::kTurbo, {35, 23, 27}, {144, 12, 0}}));

class EvenPalette : public ::testing::TestWithParam<ColourMap::PaletteCase> {};

TEST_P(EvenPalette, RisesInLightness) {
  const auto at = [&](int i) { return lightness(paletteColour(GetParam(), static_cast<float>(i) / 255.0F)); };
  // A table of eight bits is off by half a level in each component: a third of a step of L* at most.
  for (int i = 0; i < 255; ++i) EXPECT_GT(at(i + 1), at(i) - 0.1F) << i;
  for (int i = 0; i < 247; ++i) EXPECT_GT(at(i + 8), at(i) + 1.0F) << i;
  EXPECT_GT(at(255) - at(0), 60.0F);
}

INSTANTIATE_TEST_SUITE_P(Every, EvenPalette,
                         ::testing::Values(ColourMap::kViridis, ColourMap::kMagma, ColourMap::kCividis));

TEST(CoolWarm, IsLightestAndGreyInTheMiddle) {
  const Eigen::Vector3f middle = paletteColour(ColourMap::kCoolWarm, 0.5F);
  EXPECT_EQ(middle.maxCoeff(), middle.minCoeff());
  for (const float share : {0.0F, 0.25F, 0.75F, 1.0F}) {
    EXPECT_GT(lightness(middle), lightness(paletteColour(ColourMap::kCoolWarm, share)) + 5.0F) << share;
  }
}

TEST(NoPalette, IsViridis) {
  EXPECT_EQ(paletteColour(ColourMap::PALETTE_NOT_SET, 0.3F), paletteColour(ColourMap::kViridis, 0.3F));
}

TEST(Srgb, LinearLightAndBackIsTheSame) {
  for (int i = 0; i <= 255; ++i) {
    const float encoded = static_cast<float>(i) / 255.0F;
    EXPECT_NEAR(encodeSrgb(linearOfSrgb(encoded)), encoded, 1e-5F);
  }
  EXPECT_NEAR(linearOfSrgb(0.5F), 0.2140F, 1e-4F);
  EXPECT_NEAR(lightness(Eigen::Vector3f::Ones()), 100.0F, 1e-3F);
  EXPECT_EQ(lightness(Eigen::Vector3f::Zero()), 0.0F);
}

}  // namespace
}  // namespace sluice::render
