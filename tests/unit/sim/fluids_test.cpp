// Several fluids of different rest density and viscosity in one simulation.

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

struct Totals {
  std::array<double, 3> momentum{};  ///< Σ ρ0 v, of particles of one volume.
  double size = 0;                   ///< Σ ρ0 |v|.
};

Totals totalsOf(const FluidSimulation& simulation) {
  Totals totals;
  const ParticleState& state = simulation.state();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const double mass = simulation.mixture().restDensities()[state.fluid[i]];
    const Float4& v = state.velocity[i];
    totals.momentum[0] += mass * v.x;
    totals.momentum[1] += mass * v.y;
    totals.momentum[2] += mass * v.z;
    totals.size += mass * std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z));
  }
  return totals;
}

/// Mean height of each fluid, m.
std::vector<double> meanHeights(const FluidSimulation& simulation) {
  const ParticleState& state = simulation.state();
  std::vector<double> sums(simulation.mixture().restDensities().size());
  std::vector<double> counts(sums.size());
  for (std::size_t i = 0; i < state.size(); ++i) {
    sums[state.fluid[i]] += state.position[i].y;
    counts[state.fluid[i]] += 1;
  }
  for (std::size_t f = 0; f < sums.size(); ++f) sums[f] /= counts[f];
  return sums;
}

class FluidsByRatio : public testing::TestWithParam<double> {};

TEST_P(FluidsByRatio, KeepTheirMomentumInACollision) {
  FluidSimulation simulation(collidingFluids(GetParam()));
  const Totals before = totalsOf(simulation);
  runUntil(simulation, 0.3);
  ASSERT_EQ(simulation.halted(), "");
  const Totals after = totalsOf(simulation);
  // The light cube has been turned round: much has passed between the two.
  ASSERT_GT(simulation.statistics().steps, 30U);
  // Some hundred steps, each of which rounds every velocity to 2⁻²⁴ of itself; forces cancel but for as much.
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(after.momentum[axis], before.momentum[axis], 1e-6 * before.size);
}

// A light cube that meets one ten (a thousand) times as heavy bounces; the heavy one goes on.
TEST_P(FluidsByRatio, TheHeavierGivesWayLess) {
  FluidSimulation simulation(collidingFluids(GetParam()));
  runUntil(simulation, 0.3);
  ASSERT_EQ(simulation.halted(), "");
  std::array<double, 2> mean{};
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    mean[simulation.state().fluid[i]] += simulation.state().velocity[i].x / 1000;
  }
  const double heavyChange = 2 - mean[0];
  const double lightChange = mean[1] + 1;
  EXPECT_GT(lightChange, 0.5);
  EXPECT_NEAR(heavyChange * GetParam(), lightChange, 0.01);
}

TEST_P(FluidsByRatio, LieStillWithTheLighterAbove) {
  FluidSimulation simulation(layeredTank(1000, 1000 / GetParam()));
  runUntil(simulation, 1.0);
  ASSERT_EQ(simulation.halted(), "");
  const std::vector<double> heights = meanHeights(simulation);
  // As they were placed: 4.5 and 12.5 spacings, less what settling against the walls takes.
  EXPECT_NEAR(heights[0], 4.5 * 0.05, 0.02);
  EXPECT_NEAR(heights[1], 12.5 * 0.05, 0.03);
  EXPECT_LT(simulation.statistics().meanDensityError, 0.002);
  EXPECT_LT(simulation.statistics().maxSpeed, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Fluids, FluidsByRatio, testing::Values(1.5, 10.0, 1000.0));

TEST(Fluids, ALighterBelowRises) {
  FluidSimulation simulation(layeredTank(500, 1000));
  const std::vector<double> before = meanHeights(simulation);
  ASSERT_LT(before[0], before[1]);
  // It stays in its unstable equilibrium until roundings have grown, a little over 2 s.
  runUntil(simulation, 5);
  ASSERT_EQ(simulation.halted(), "");
  const std::vector<double> after = meanHeights(simulation);
  EXPECT_GT(after[0], after[1] + 0.1);
  EXPECT_LT(simulation.statistics().meanDensityError, 0.005);
}

// κ ρ_max / dt is the pressure: it grows with depth as the weight above does, across where two fluids meet.
TEST(Fluids, PressureIsTheWeightOfWhatIsAbove) {
  v1::Simulation settings = layeredTank(1000, 250);
  settings.mutable_dfsph()->set_density_error(0.005);
  FluidSimulation simulation(settings);
  runUntil(simulation, 1.0);
  constexpr std::size_t kLayers = 16;
  std::array<double, kLayers> pressure{};
  std::array<double, kLayers> count{};
  for (int step = 0; step < 50; ++step) {
    ASSERT_TRUE(simulation.advance());
    const ParticleState& state = simulation.state();
    for (std::size_t i = 0; i < state.size(); ++i) {
      const Float4& x = state.position[i];
      const auto inside = [](float place) { return place > 0.12F && place < 11 * 0.05F - 0.12F; };
      if (!inside(x.x) || !inside(x.z)) continue;
      const auto layer = static_cast<std::size_t>(std::clamp(x.y / 0.05F - 0.5F, 0.0F, kLayers - 1.0F));
      pressure[layer] +=
          state.densityImpulse[i] * simulation.mixture().heaviest() / simulation.statistics().timeStepSeconds;
      count[layer] += 1;
    }
  }
  const auto gradient = [&](std::size_t low, std::size_t high) {
    return (pressure[low] / count[low] - pressure[high] / count[high]) / (static_cast<double>(high - low) * 0.05);
  };
  // Without the lowest layers, whose pressure is uneven: the floor answers with κ_i alone.
  EXPECT_NEAR(gradient(2, 6), 1000 * 9.81, 0.15 * 1000 * 9.81);
  EXPECT_NEAR(gradient(9, 13), 250 * 9.81, 0.15 * 250 * 9.81);
}

TEST(Fluids, SameBitsForAnyNumberOfThreadsAndAnyInstructionSet) {
  const v1::Simulation settings = layeredTank(500, 1000);
  const auto stateAfter = [&](const SimulationOptions& options) {
    FluidSimulation simulation(settings, options);
    for (int step = 0; step < 60; ++step) EXPECT_TRUE(simulation.advance());
    return simulation.state();
  };
  const ParticleState one = stateAfter({.threads = 1});
  for (const int threads : {2, 4}) EXPECT_TRUE(stateAfter({.threads = threads}) == one) << threads << " threads";
  for (const PairLoops* loops : availablePairLoops()) {
    EXPECT_TRUE(stateAfter({.threads = 2, .loops = loops}) == one) << loops->instructionSet;
  }
}

// Fluids that differ in nothing the solver knows of are one fluid to it.
TEST(Fluids, TwoThatAreAlikeMoveAsOneBitForBit) {
  v1::Simulation one = smallDamBreak();
  v1::Block beside = one.fluids(0).blocks(0);
  beside.mutable_first_particle()->set_x(0.55);
  beside.set_count_y(8);
  v1::Simulation two = one;
  *one.mutable_fluids(0)->add_blocks() = beside;
  addFluid(two, 1000, one.fluids(0).viscosity(), beside);
  FluidSimulation a(one);
  FluidSimulation b(two);
  for (int step = 0; step < 60; ++step) {
    ASSERT_TRUE(a.advance());
    ASSERT_TRUE(b.advance());
  }
  ASSERT_EQ(b.state().fluid.size(), b.state().size());
  ParticleState unnamed = b.state();
  unnamed.fluid.clear();
  EXPECT_TRUE(a.state() == unnamed);
}

TEST(Fluids, ParticlesKeepTheirFluidThroughSortingAndReset) {
  FluidSimulation simulation(layeredTank(500, 1000));
  const auto expectRightFluids = [&] {
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      ASSERT_EQ(simulation.state().fluid[i], simulation.state().id[i] < 800 ? 0 : 1);
    }
  };
  expectRightFluids();
  runUntil(simulation, 0.5);
  expectRightFluids();
  simulation.reset();
  expectRightFluids();
}

TEST(Fluids, SnapshotTellsThemApart) {
  FluidSimulation simulation(layeredTank(1000, 250));
  ASSERT_TRUE(simulation.advance());
  const auto snapshot = simulation.snapshot();
  EXPECT_THAT(snapshot->restDensities, testing::ElementsAre(1000, 250));
  ASSERT_EQ(snapshot->fluids.size(), snapshot->size());
  EXPECT_TRUE(snapshot->fluids == simulation.state().fluid);
  for (std::size_t i = 0; i < snapshot->size(); ++i) {
    const double restDensity = snapshot->restDensities[snapshot->fluids[i]];
    // At most slightly compressed; at least half full, in an edge of the free surface.
    ASSERT_LT(snapshot->densities[i], 1.1 * restDensity);
    ASSERT_GT(snapshot->densities[i], 0.5 * restDensity);
  }
}

TEST(Fluids, SnapshotOfOneDoesNotNameIt) {
  FluidSimulation simulation(smallDamBreak());
  EXPECT_THAT(simulation.snapshot()->fluids, testing::IsEmpty());
  EXPECT_THAT(simulation.snapshot()->restDensities, testing::IsEmpty());
  EXPECT_THAT(simulation.state().fluid, testing::IsEmpty());
}

TEST(Fluids, ViscosityStageRunsWhileAnyIsViscous) {
  v1::Simulation settings = layeredTank(1000, 500);
  settings.mutable_fluids(0)->set_viscosity(0);
  EXPECT_TRUE(planStep(settings, {.particles = 1}).contains(Stage::Viscosity));
  settings.mutable_fluids(1)->set_viscosity(0);
  EXPECT_FALSE(planStep(settings, {.particles = 1}).contains(Stage::Viscosity));
}

TEST(Fluids, EachIsBrakedByItsOwnViscosity) {
  // Two sheared cubes far from each other: the viscous one calms down.
  v1::Simulation settings = floatingCube(8);
  v1::Block* lower = settings.mutable_fluids(0)->mutable_blocks(0);
  lower->set_count_y(4);
  lower->mutable_first_particle()->set_x(-2);
  v1::Block upper = *lower;
  upper.mutable_first_particle()->set_y(lower->first_particle().y() + 4 * 0.05);
  upper.mutable_velocity()->set_x(0.2);
  *settings.mutable_fluids(0)->add_blocks() = upper;
  v1::Fluid* viscous = settings.add_fluids();
  *viscous = settings.fluids(0);
  viscous->set_rest_density(3000);
  viscous->set_viscosity(0.1);
  for (v1::Block& block : *viscous->mutable_blocks()) block.mutable_first_particle()->set_x(2);
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.1);
  std::array<double, 2> shear{};
  const ParticleState& state = simulation.state();
  for (std::size_t i = 0; i < state.size(); ++i) {
    shear[state.fluid[i]] += (state.id[i] / 256 % 2 == 0 ? -1 : 1) * state.velocity[i].x / 256;
  }
  EXPECT_NEAR(shear[0], 0.2, 0.01);
  EXPECT_LT(shear[1], 0.7 * shear[0]);
  EXPECT_GT(shear[1], 0);
}

TEST(Fluids, ViscositiesChangeWhileItRuns) {
  v1::Simulation settings = collidingFluids(10);
  settings.mutable_explicit_viscosity();
  FluidSimulation simulation(settings);
  settings.mutable_fluids(1)->set_viscosity(3);
  simulation.update(sceneOf(settings));
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(simulation.statistics().timeStepLimit, "viscosity");
}

TEST(Fluids, OverlapOfTwoIsRefusedAtTheLater) {
  v1::Simulation settings = layeredTank(1000, 500);
  settings.mutable_fluids(1)->mutable_blocks(0)->mutable_first_particle()->set_y(0.40);
  try {
    const FluidSimulation simulation(settings);
    FAIL() << "taken, though the fluids overlap";
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "simulation.fluids[1].blocks[0].first_particle");
    EXPECT_THAT(error.problem(), testing::HasSubstr("overlaps simulation.fluids[0].blocks[0]"));
  }
}

TEST(Fluids, TheSecondOutsideTheContainerIsRefused) {
  v1::Simulation settings = layeredTank(1000, 500);
  settings.mutable_fluids(1)->mutable_blocks(0)->set_count_y(100);
  try {
    const FluidSimulation simulation(settings);
    FAIL() << "taken, though the fluid reaches out of the container";
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "simulation.fluids[1].blocks[0].first_particle");
  }
}

}  // namespace
}  // namespace sluice::sim
