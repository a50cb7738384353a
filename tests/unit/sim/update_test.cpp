#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

double meanVelocityX(const FluidSimulation& simulation) {
  double sum = 0;
  for (const Float4& v : simulation.state().velocity) sum += v.x;
  return sum / static_cast<double>(simulation.state().size());
}

TEST(Update, GravityTakesEffectInTheNextStep) {
  v1::Simulation settings = floatingCube(5);
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(meanVelocityX(simulation), 0);
  settings.mutable_gravity()->set_x(2);
  simulation.update(sceneOf(settings));
  ASSERT_TRUE(simulation.advance());
  EXPECT_NEAR(meanVelocityX(simulation), 2 * simulation.statistics().timeStepSeconds, 1e-6);
}

TEST(Update, ViscosityEntersAndLeavesThePlan) {
  v1::Simulation settings = smallDamBreak();
  FluidSimulation simulation(settings);
  const std::size_t stages = simulation.plan().stages.size();
  settings.mutable_fluids(0)->set_viscosity(0);
  simulation.update(sceneOf(settings));
  EXPECT_EQ(simulation.plan().stages.size(), stages - 1);
  EXPECT_THAT(simulation.plan().leftOut, testing::Contains(core::LeftOut{"viscosity", "the viscosity is 0"}));
}

// Once the column runs, a tighter tolerance costs iterations and leaves less compression.
TEST(Update, TighterToleranceLeavesLessCompression) {
  v1::Simulation settings = smallDamBreak();
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.2);
  const auto meanOverSteps = [&] {
    double error = 0;
    double iterations = 0;
    for (int step = 0; step < 20; ++step) {
      EXPECT_TRUE(simulation.advance());
      error += simulation.statistics().meanDensityError / 20;
      iterations += simulation.statistics().densityIterations / 20.0;
    }
    return std::pair(error, iterations);
  };
  const auto [looseError, looseIterations] = meanOverSteps();
  settings.mutable_dfsph()->set_density_error(0.005);
  simulation.update(sceneOf(settings));
  const auto [tightError, tightIterations] = meanOverSteps();
  EXPECT_LT(tightError, looseError);
  EXPECT_GT(tightIterations, looseIterations);
}

TEST(Update, SceneThatIsNoSimulationIsRefusedAndChangesNothing) {
  FluidSimulation simulation(smallDamBreak());
  const core::Plan before = simulation.plan();
  EXPECT_THROW(simulation.update(v1::Scene()), core::InputError);
  v1::Simulation settings = smallDamBreak();
  settings.mutable_gravity()->set_y(0);
  settings.mutable_time_step()->set_min_seconds(1);
  EXPECT_THROW(simulation.update(sceneOf(settings)), core::InputError);
  EXPECT_EQ(simulation.plan(), before);
}

}  // namespace
}  // namespace sluice::sim
