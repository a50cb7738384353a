#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

ParticleState stateAfter(const v1::Simulation& settings, int steps, const SimulationOptions& options) {
  FluidSimulation simulation(settings, options);
  for (int step = 0; step < steps; ++step) EXPECT_TRUE(simulation.advance());
  return simulation.state();
}

TEST(Determinism, SameBitsForAnyNumberOfThreadsAndAnyRun) {
  const v1::Simulation settings = smallDamBreak();
  const ParticleState one = stateAfter(settings, 60, {.threads = 1});
  for (const int threads : {1, 2, 4}) {
    EXPECT_TRUE(stateAfter(settings, 60, {.threads = threads}) == one) << threads << " threads";
  }
}

TEST(Determinism, SameBitsForAnyInstructionSet) {
  const v1::Simulation settings = smallDamBreak();
  const ParticleState best = stateAfter(settings, 60, {.threads = 2});
  for (const PairLoops* loops : availablePairLoops()) {
    EXPECT_TRUE(stateAfter(settings, 60, {.threads = 2, .loops = loops}) == best) << loops->instructionSet;
  }
}

TEST(Reset, ReturnsToTheInitialStateAndRunsTheSameAgain) {
  FluidSimulation simulation(smallDamBreak(), {.threads = 2});
  const ParticleState initial = simulation.state();
  for (int step = 0; step < 40; ++step) ASSERT_TRUE(simulation.advance());
  const ParticleState moved = simulation.state();
  const double time = simulation.time();

  simulation.reset();
  EXPECT_TRUE(simulation.state() == initial);
  EXPECT_EQ(simulation.time(), 0);
  EXPECT_EQ(simulation.statistics().steps, 0U);
  for (int step = 0; step < 40; ++step) ASSERT_TRUE(simulation.advance());
  EXPECT_TRUE(simulation.state() == moved);
  EXPECT_EQ(simulation.time(), time);
}

TEST(Snapshot, HoldsEveryParticleOnce) {
  FluidSimulation simulation(smallDamBreak());
  for (int step = 0; step < 20; ++step) ASSERT_TRUE(simulation.advance());
  const auto snapshot = simulation.snapshot();
  ASSERT_EQ(snapshot->size(), 3000U);
  ASSERT_EQ(snapshot->velocities.size(), 3000U);
  ASSERT_EQ(snapshot->densities.size(), 3000U);
  std::vector<std::uint32_t> ids = snapshot->ids;
  std::sort(ids.begin(), ids.end());
  for (std::uint32_t i = 0; i < ids.size(); ++i) ASSERT_EQ(ids[i], i);
  EXPECT_EQ(snapshot->statistics.steps, 20U);
  EXPECT_DOUBLE_EQ(snapshot->time, simulation.time());
  EXPECT_FALSE(snapshot->statistics.stages.empty());
}

TEST(Snapshot, CountsNeighboursInTheFluidAlone) {
  FluidSimulation simulation(smallDamBreak());
  for (int step = 0; step < 20; ++step) ASSERT_TRUE(simulation.advance());
  const auto snapshot = simulation.snapshot();
  ASSERT_EQ(snapshot->neighbours.size(), snapshot->size());
  EXPECT_NEAR(snapshot->supportRadius, 2 * snapshot->spacing, 1e-9);
  int atWalls = 0;
  for (std::size_t i = 0; i < snapshot->size(); ++i) {
    int expected = 0;
    for (std::size_t j = 0; j < snapshot->size(); ++j) {
      const float distance = (snapshot->positions[i] - snapshot->positions[j]).norm();
      if (j != i && distance < snapshot->supportRadius) ++expected;
    }
    // The snapshot's positions are rounded once more: a pair at the very end of the reach may fall either way.
    ASSERT_NEAR(snapshot->neighbours[i], expected, 1);
    if (simulation.neighbours().neighbours()[i] > snapshot->neighbours[i]) ++atWalls;
  }
  EXPECT_GT(atWalls, 100);
}

}  // namespace
}  // namespace sluice::sim
