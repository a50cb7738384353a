#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

using testing::HasSubstr;

void expectFinite(const core::ParticleSnapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    ASSERT_TRUE(snapshot.positions[i].allFinite());
    ASSERT_TRUE(snapshot.velocities[i].allFinite());
    ASSERT_TRUE(std::isfinite(snapshot.densities[i]));
  }
}

/// Two cubes that meet head-on at `speed`, solved with two iterations.
v1::Simulation collision(double speed) {
  v1::Simulation settings = floatingCube(10);
  v1::Block* left = settings.mutable_fluids(0)->mutable_blocks(0);
  v1::Block* right = settings.mutable_fluids(0)->add_blocks();
  *right = *left;
  left->mutable_first_particle()->set_x(-0.55);
  right->mutable_first_particle()->set_x(0.05);
  left->mutable_velocity()->set_x(speed);
  right->mutable_velocity()->set_x(-speed);
  settings.mutable_dfsph()->set_max_iterations(2);
  return settings;
}

TEST(Trouble, AStepThatCannotBeRightHaltsWithTheLastGoodState) {
  v1::Simulation settings = collision(1000);
  // Below a step of this length, the second of the two bounds cannot be met.
  settings.mutable_time_step()->set_min_seconds(1e-5);
  FluidSimulation simulation(settings);
  int steps = 0;
  ParticleState good = simulation.state();
  double time = 0;
  while (simulation.advance() && steps++ < 2000) {
    good = simulation.state();
    time = simulation.time();
    expectFinite(*simulation.snapshot());
  }
  ASSERT_NE(simulation.halted(), "");
  EXPECT_THAT(simulation.halted(), HasSubstr("simulation.time_step.min_seconds"));
  EXPECT_TRUE(simulation.state() == good);
  EXPECT_EQ(simulation.time(), time);
  expectFinite(*simulation.snapshot());
  EXPECT_FALSE(simulation.advance());
}

TEST(Trouble, AShorterStepSavesWhatALongOneCannot) {
  v1::Simulation settings = collision(20);
  settings.mutable_time_step()->set_cfl(1);
  settings.mutable_dfsph()->set_max_iterations(3);
  FluidSimulation simulation(settings);
  bool recovered = false;
  for (int step = 0; step < 200 && simulation.advance(); ++step) {
    recovered = recovered || simulation.statistics().timeStepLimit == "recovery";
    expectFinite(*simulation.snapshot());
  }
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_TRUE(recovered);
}

TEST(Trouble, HaltNamesTheBoundThatDemandsTooShortAStep) {
  v1::Simulation settings = collision(1000);
  settings.mutable_time_step()->set_min_seconds(1e-3);
  FluidSimulation simulation(settings);
  EXPECT_FALSE(simulation.advance());
  EXPECT_THAT(simulation.halted(), HasSubstr("\"cfl\""));
  EXPECT_EQ(simulation.time(), 0);
}

/// A step that fails before anything has moved, after some that went well, leaves the state as it was.
void expectStateKept(v1::Simulation settings) {
  FluidSimulation simulation(settings);
  for (int step = 0; step < 10; ++step) ASSERT_TRUE(simulation.advance());
  ASSERT_LT(simulation.statistics().timeStepSeconds, 0.01);
  const ParticleState good = simulation.state();
  settings.mutable_time_step()->set_max_seconds(0.1);
  settings.mutable_time_step()->set_min_seconds(0.1);
  simulation.update(sceneOf(settings));
  ASSERT_FALSE(simulation.advance());
  EXPECT_TRUE(simulation.state() == good);
}

TEST(Trouble, AStepThatFailsBeforeTheMoveLeavesEverySolversState) {
  v1::Simulation settings = collision(5);
  {
    SCOPED_TRACE("dfsph");
    settings.mutable_dfsph()->set_max_iterations(100);
    expectStateKept(settings);
  }
  {
    SCOPED_TRACE("iisph");
    settings.mutable_iisph();
    expectStateKept(settings);
  }
  {
    SCOPED_TRACE("pbf");
    settings.mutable_pbf();
    expectStateKept(settings);
  }
  {
    SCOPED_TRACE("wcsph");
    settings.mutable_wcsph();
    expectStateKept(settings);
  }
}

TEST(Trouble, AStepThatFailsInFreeFlightLeavesTheState) {
  v1::Simulation settings = floatingCube(1);
  settings.mutable_gravity()->set_y(-9.81);
  *settings.mutable_fluids(0)->add_blocks() = settings.fluids(0).blocks(0);
  settings.mutable_fluids(0)->mutable_blocks(1)->mutable_first_particle()->set_x(-1);
  settings.mutable_fluids(0)->mutable_blocks(1)->mutable_velocity()->set_y(8);
  expectStateKept(settings);
}

TEST(Trouble, AnUpdateLetsAHaltedSimulationTryAgain) {
  v1::Simulation settings = collision(100);
  settings.mutable_time_step()->set_min_seconds(1e-3);
  FluidSimulation simulation(settings);
  ASSERT_FALSE(simulation.advance());
  settings.mutable_time_step()->set_min_seconds(1e-6);
  simulation.update(sceneOf(settings));
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_TRUE(simulation.advance());
}

}  // namespace
}  // namespace sluice::sim
