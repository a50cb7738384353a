// Values of particles for colours: each attribute, what is missing, and ranges that rest and read well.
#include "particle_values.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace sluice::render {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::IsEmpty;
using v1::ColourMap;

core::ParticleSnapshot two() {
  core::ParticleSnapshot particles;
  particles.restDensity = 800;
  particles.positions = {{0, 0, 0}, {1, 0, 0}};
  particles.velocities = {{3, 0, -4}, {0, 0.5F, 0}};
  particles.densities = {800, 820};
  particles.pressures = {0, 1500};
  particles.ages = {0.25F, 2};
  particles.ids = {7, 9};
  return particles;
}

TEST(ParticleValues, AreInTheUnitOfTheirText) {
  const core::ParticleSnapshot particles = two();
  EXPECT_THAT(valuesOf(ColourMap::kSpeed, particles), ElementsAre(5, 0.5F));
  EXPECT_EQ(textOf(ColourMap::kSpeed).unit, "m/s");
  EXPECT_THAT(valuesOf(ColourMap::kPressure, particles), ElementsAre(0, 1500));
  EXPECT_EQ(textOf(ColourMap::kPressure).unit, "Pa");
  EXPECT_THAT(valuesOf(ColourMap::kDensityError, particles), ElementsAre(FloatNear(0, 1e-4F), FloatNear(2.5F, 1e-4F)));
  EXPECT_EQ(textOf(ColourMap::kDensityError).unit, "%");
  EXPECT_THAT(valuesOf(ColourMap::kAge, particles), ElementsAre(0.25F, 2));
  EXPECT_EQ(textOf(ColourMap::kAge).unit, "s");
  EXPECT_THAT(valuesOf(ColourMap::kParticleId, particles), ElementsAre(7, 9));
  EXPECT_EQ(textOf(ColourMap::kParticleId).unit, "");
}

TEST(ParticleValues, SayWhatIsMissing) {
  core::ParticleSnapshot particles;
  particles.positions = {{0, 0, 0}};
  for (const auto attribute :
       {ColourMap::kSpeed, ColourMap::kPressure, ColourMap::kDensityError, ColourMap::kAge, ColourMap::kParticleId}) {
    EXPECT_THAT(valuesOf(attribute, particles), IsEmpty()) << attribute;
    EXPECT_THAT(missingFor(attribute, particles), ::testing::HasSubstr("the source gives no ")) << attribute;
    EXPECT_EQ(missingFor(attribute, two()), "") << attribute;
  }
}

TEST(Velocities, AreSpeedOrAlongADirectionOfAnyLength) {
  v1::VelocityMap map;
  map.mutable_direction()->set_z(-0.5);
  EXPECT_THAT(velocitiesOf(map, two()), ElementsAre(FloatNear(4, 1e-6F), FloatNear(0, 1e-6F)));
  map.mutable_direction()->set_z(0);
  EXPECT_THAT(velocitiesOf(map, two()), ElementsAre(5, 0.5F));
  EXPECT_THAT(velocitiesOf(map, core::ParticleSnapshot{}), IsEmpty());
}

TEST(NiceStep, IsTheLeastThatIsNotBelow) {
  EXPECT_DOUBLE_EQ(niceStep(0.3), 0.5);
  EXPECT_DOUBLE_EQ(niceStep(0.1 + 0.1), 0.2);
  EXPECT_DOUBLE_EQ(niceStep(1.01), 2);
  EXPECT_DOUBLE_EQ(niceStep(7000), 10000);
  EXPECT_DOUBLE_EQ(niceStep(1e-6), 1e-6);
}

std::vector<float> evenly(float least, float most, int count = 1001) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) values.push_back(std::lerp(least, most, static_cast<float>(i) / (count - 1)));
  return values;
}

TEST(RobustRange, LeavesStraysOutAndEndsAtRoundNumbers) {
  std::vector<float> values = evenly(0, 2.93F);
  values[500] = 1e9F;
  values[501] = -1e9F;
  values[502] = std::numeric_limits<float>::quiet_NaN();
  values[503] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(robustRange(values, false), (ValueRange{0, 3}));
}

TEST(RobustRange, OfOneValueHasAWidthAroundIt) {
  for (const float value : {0.0F, 5.0F, -0.25F}) {
    const ValueRange range = robustRange(std::vector<float>(50, value), false);
    EXPECT_LE(range.least, value);
    EXPECT_GE(range.most, value);
    EXPECT_GT(range.width(), 0.0F);
  }
  EXPECT_GT(robustRange({}, false).width(), 0.0F);
}

TEST(RobustRange, AboutZeroIsSymmetricWhereItHolds0) {
  const ValueRange range = robustRange(evenly(-1, 4), true);
  EXPECT_EQ(range.least, -range.most);
  EXPECT_GE(range.most, 3.9F);
  EXPECT_GT(robustRange(evenly(1, 4), true).least, 0.0F);
}

TEST(RobustRange, IsKeptWhileItFits) {
  const ValueRange before{0, 3};
  EXPECT_EQ(robustRange(evenly(0.2F, 2.5F), false, &before), before);
  EXPECT_NE(robustRange(evenly(0.2F, 3.5F), false, &before), before) << "more than it holds";
  EXPECT_NE(robustRange(evenly(0.2F, 1.5F), false, &before), before) << "little of it";
}

}  // namespace
}  // namespace sluice::render
