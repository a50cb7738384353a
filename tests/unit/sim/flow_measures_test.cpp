#include <cmath>

#include <gtest/gtest.h>

#include "fluid_simulation.h"
#include "scenes.h"

namespace sluice::sim {
namespace {

/// A cube of fluid in the middle of a box far away.
v1::Simulation dropInABox() {
  v1::Simulation settings;
  settings.set_particle_spacing(0.05);
  settings.mutable_gravity()->set_y(-9.81);
  for (const auto& [corner, at] : {std::pair{settings.mutable_container()->mutable_min(), -5.0},
                                   {settings.mutable_container()->mutable_max(), 5.0}}) {
    corner->set_x(at);
    corner->set_y(at);
    corner->set_z(at);
  }
  v1::Fluid& fluid = *settings.add_fluids();
  fluid.set_rest_density(1000);
  fluid.set_viscosity(0.05);
  v1::Block& block = *fluid.add_blocks();
  block.mutable_first_particle()->set_x(0);
  block.mutable_first_particle()->set_y(1);
  block.mutable_first_particle()->set_z(0);
  block.set_count_x(6);
  block.set_count_y(6);
  block.set_count_z(6);
  return settings;
}

TEST(FlowMeasures, EnergiesOfAFreeFallAreThoseOfABodyThatFalls) {
  FluidSimulation simulation(dropInABox());
  const double mass = 216 * 0.05 * 0.05 * 0.05 * 1000;
  const double middle = 1 + 2.5 * 0.05;
  EXPECT_NEAR(simulation.measures().potentialEnergy, mass * 9.81 * middle, 1e-4 * mass * 9.81);
  EXPECT_EQ(simulation.measures().kineticEnergy, 0);
  simulation.stopAt(0.3);
  while (simulation.time() < 0.3) ASSERT_TRUE(simulation.advance());
  const core::FlowMeasures measures = simulation.measures();
  const double speed = 9.81 * 0.3;
  EXPECT_NEAR(measures.kineticEnergy / (0.5 * mass * speed * speed), 1, 1e-3);
  // Symplectic Euler gains or loses of the order of one step's fall.
  EXPECT_NEAR((measures.kineticEnergy + measures.potentialEnergy) / (mass * 9.81 * middle), 1, 0.02);
}

TEST(FlowMeasures, PairsMakeNoMomentum) {
  v1::Simulation settings = dropInABox();
  settings.mutable_fluids(0)->mutable_blocks(0)->mutable_velocity()->set_x(1);
  FluidSimulation simulation(settings);
  while (simulation.time() < 0.2) ASSERT_TRUE(simulation.advance());
  EXPECT_LT(simulation.measures().momentumDrift, 1e-4);
}

TEST(FlowMeasures, AnIncompressibleFlowHasLittleDivergence) {
  FluidSimulation simulation(dropInABox());
  while (simulation.time() < 0.1) ASSERT_TRUE(simulation.advance());
  const core::FlowMeasures measures = simulation.measures();
  EXPECT_LT(measures.meanDivergence, 0.5);
  EXPECT_GE(measures.maxDivergence, measures.meanDivergence);
}

TEST(FlowMeasures, WithoutParticlesTheyAreZero) {
  v1::Simulation settings = dropInABox();
  settings.mutable_fluids(0)->clear_blocks();
  v1::Emitter& emitter = *settings.mutable_fluids(0)->add_emitters();
  emitter.set_radius(0.2);
  emitter.set_speed(1);
  emitter.set_start_seconds(100);
  emitter.mutable_direction()->set_y(-1);
  const FluidSimulation simulation(settings);
  EXPECT_EQ(simulation.measures().kineticEnergy, 0);
  EXPECT_EQ(simulation.measures().maxDivergence, 0);
}

}  // namespace
}  // namespace sluice::sim
