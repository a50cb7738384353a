// What a simulation holds, as its plan tells.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

std::vector<std::string> bufferNames(const FluidSimulation& simulation) {
  std::vector<std::string> names;
  for (const core::PlannedBuffer& buffer : simulation.plan().buffers) names.push_back(buffer.name);
  return names;
}

constexpr char kBeginning[] = "state at the step's beginning";

TEST(Memory, OfAParticleIsBelow600BytesInAPool) {
  FluidSimulation simulation(column(22, 20));
  for (int step = 0; step < 3; ++step) ASSERT_TRUE(simulation.advance());
  double bytes = 0;
  for (const core::PlannedBuffer& buffer : simulation.plan().buffers) bytes += static_cast<double>(buffer.bytes);
  EXPECT_LT(bytes / static_cast<double>(simulation.state().size()), 600);
}

// A step is taken back to the state before its sort; only one that none has sorted before needs a copy.
TEST(Memory, OfTheFirstStepsCopyIsGivenUp) {
  FluidSimulation simulation(smallDamBreak());
  EXPECT_THAT(bufferNames(simulation), testing::Contains(kBeginning));
  ASSERT_TRUE(simulation.advance());
  ASSERT_TRUE(simulation.advance());
  EXPECT_THAT(bufferNames(simulation), testing::Not(testing::Contains(kBeginning)));
}

TEST(Memory, OfASolverThatMovesParticlesAfterTheSortHasTheCopy) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_pbf();
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  ASSERT_TRUE(simulation.advance());
  EXPECT_THAT(bufferNames(simulation), testing::Contains(kBeginning));
}

}  // namespace
}  // namespace sluice::sim
