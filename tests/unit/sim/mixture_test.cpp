#include "mixture.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sluice::sim {
namespace {

struct Properties {
  double restDensity;
  double viscosity;
};

Mixture mixtureOf(std::initializer_list<Properties> fluids) {
  v1::Simulation simulation;
  for (const Properties& properties : fluids) {
    v1::Fluid* fluid = simulation.add_fluids();
    fluid->set_rest_density(properties.restDensity);
    fluid->set_viscosity(properties.viscosity);
  }
  return Mixture(simulation);
}

const std::vector<std::uint8_t> kIndices{0, 1};

TEST(Mixture, TheHeaviestFluidMovesLeast) {
  const Mobility mobility = mixtureOf({{800, 0}, {2000, 0}}).mobility(kIndices);
  EXPECT_EQ(mobility.fluid, kIndices.data());
  EXPECT_FLOAT_EQ(mobility.ofFluid[0], 2.5F);
  EXPECT_FLOAT_EQ(mobility.ofFluid[1], 1);
}

TEST(Mixture, FluidsThatWeighTheSameNeedNoMobilities) {
  EXPECT_EQ(mixtureOf({{800, 0}, {800, 1}}).mobility(kIndices).fluid, nullptr);
  EXPECT_EQ(mixtureOf({{1200, 0.1}}).mobility({}).fluid, nullptr);
}

TEST(Mixture, FrictionBetweenFluidsIsTheSameForBoth) {
  const PairStrength friction = mixtureOf({{800, 0.02}, {2000, 0.3}}).friction(kIndices, 0.001);
  // Force per volume: acceleration times rest density.
  EXPECT_FLOAT_EQ(800 * friction.strength[0][1], 2000 * friction.strength[1][0]);
  // The harmonic mean of 16 and 600 Pa s.
  EXPECT_FLOAT_EQ(800 * friction.strength[0][1], static_cast<float>(10 * 0.001 * 2 * 16 * 600 / 616));
  EXPECT_FLOAT_EQ(friction.strength[1][1], static_cast<float>(10 * 0.001 * 0.3));
}

TEST(Mixture, AFluidWithoutViscositySlidesAlongAnyOther) {
  const PairStrength friction = mixtureOf({{1000, 0}, {1000, 1}}).friction(kIndices, 0.001);
  EXPECT_EQ(friction.strength[0][1], 0);
  EXPECT_EQ(friction.strength[1][0], 0);
  EXPECT_GT(friction.strength[1][1], 0);
}

TEST(Mixture, FluidsThatAreAlikeShareOneFriction) {
  EXPECT_EQ(mixtureOf({{1000, 0.1}, {1000, 0.1}}).friction(kIndices, 0.001).fluid, nullptr);
  EXPECT_NE(mixtureOf({{1000, 0.1}, {1000, 0.2}}).friction(kIndices, 0.001).fluid, nullptr);
  EXPECT_NE(mixtureOf({{1000, 0.1}, {500, 0.1}}).friction(kIndices, 0.001).fluid, nullptr);
}

// What bounds the time step is what a particle feels, which for a light one in heavy honey is more than its own.
TEST(Mixture, LargestViscosityIsWhatAnyParticleFeels) {
  EXPECT_DOUBLE_EQ(mixtureOf({{1000, 0.3}}).largestViscosity(), 0.3);
  EXPECT_DOUBLE_EQ(mixtureOf({{1000, 0}, {10, 0}}).largestViscosity(), 0);
  const double light = 10 * 0.2;
  const double heavy = 1000 * 0.1;
  EXPECT_DOUBLE_EQ(mixtureOf({{10, 0.2}, {1000, 0.1}}).largestViscosity(), 2 * light * heavy / (light + heavy) / 10);
}

}  // namespace
}  // namespace sluice::sim
