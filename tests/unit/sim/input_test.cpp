#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"
#include "sluice/sim/simulation.h"

namespace sluice::sim {
namespace {

using testing::HasSubstr;

void expectRefused(const v1::Simulation& settings, const std::string& fieldPath, const std::string& reason) {
  try {
    const auto simulation = makeSimulation(sceneOf(settings), 1);
    FAIL() << "taken, though " << reason;
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), fieldPath);
    EXPECT_THAT(error.problem(), HasSubstr(reason));
  }
}

v1::Block* block(v1::Simulation& settings, int index) { return settings.mutable_fluids(0)->mutable_blocks(index); }

TEST(Input, FluidOutsideTheContainerIsRefused) {
  v1::Simulation settings = smallDamBreak();
  block(settings, 0)->set_count_x(40);
  expectRefused(settings, "simulation.fluids[0].blocks[0].first_particle", "within [0.05, 1.55] m");
}

TEST(Input, FluidInsideAWallIsRefused) {
  v1::Simulation settings = smallDamBreak();
  block(settings, 0)->mutable_first_particle()->set_y(0.02);
  expectRefused(settings, "simulation.fluids[0].blocks[0].first_particle", "y = 0.02 m");
}

TEST(Input, OverlappingBlocksAreRefused) {
  v1::Simulation settings = smallDamBreak();
  *settings.mutable_fluids(0)->add_blocks() = *block(settings, 0);
  block(settings, 1)->mutable_first_particle()->set_x(0.3);
  expectRefused(settings, "simulation.fluids[0].blocks[1].first_particle", "overlaps simulation.fluids[0].blocks[0]");
}

TEST(Input, TouchingBlocksAreTaken) {
  v1::Simulation settings = smallDamBreak();
  *settings.mutable_fluids(0)->add_blocks() = *block(settings, 0);
  block(settings, 1)->mutable_first_particle()->set_x(0.05 + 10 * 0.05);
  EXPECT_NO_THROW(makeSimulation(sceneOf(settings), 1));
}

TEST(Input, MoreParticlesThanMemoryAreRefusedBeforeAnyIsMade) {
  v1::Simulation settings = smallDamBreak();
  settings.set_particle_spacing(1e-4);
  for (auto set : {&v1::Block::set_count_x, &v1::Block::set_count_y, &v1::Block::set_count_z}) {
    std::invoke(set, block(settings, 0), 10000);
  }
  expectRefused(settings, "simulation.container", "boundary particles");
  settings.set_particle_spacing(0.05);
  expectRefused(settings, "simulation.fluids[0].blocks[0]", "memory allows");
}

TEST(Input, ContainerSmallerThanTheSpacingIsRefused) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_container()->mutable_max()->set_z(0.04);
  expectRefused(settings, "simulation.container.max", "at least two particle spacings");
}

TEST(Input, SceneWithoutFluidIsRefused) {
  v1::Simulation settings = smallDamBreak();
  settings.clear_fluids();
  expectRefused(settings, "simulation.fluids", "at least one");
}

TEST(Input, SceneWithoutSimulationIsRefused) { EXPECT_THROW(makeSimulation(v1::Scene()), core::InputError); }

TEST(Input, NonFinitePlaceIsRefused) {
  v1::Simulation settings = smallDamBreak();
  block(settings, 0)->mutable_first_particle()->set_x(std::numeric_limits<double>::quiet_NaN());
  expectRefused(settings, "simulation.fluids[0].blocks[0].first_particle", "within");
}

TEST(Input, ASingleParticleIsASimulation) {
  v1::Simulation settings = floatingCube(1);
  const auto simulation = makeSimulation(sceneOf(settings), 2);
  EXPECT_TRUE(simulation->advance());
  EXPECT_EQ(simulation->snapshot()->size(), 1U);
}

}  // namespace
}  // namespace sluice::sim
