#include "time_step.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace sluice::sim {
namespace {

TimeStepInputs stillWater() {
  return {.spacing = 0.05, .support = 0.1, .maxSpeed = 0, .acceleration = 9.81, .viscosity = 0.01};
}

TEST(TimeStep, FollowsTheFastestParticle) {
  TimeStepInputs inputs = stillWater();
  inputs.maxSpeed = 8;
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_DOUBLE_EQ(choice.seconds, 0.4 * 0.05 / 8);
  EXPECT_EQ(choice.limit, "cfl");
}

TEST(TimeStep, IsAtMostMaxSecondsWhenNothingMoves) {
  const TimeStepChoice choice = chooseTimeStep({}, stillWater());
  EXPECT_DOUBLE_EQ(choice.seconds, 0.005);
  EXPECT_EQ(choice.limit, "max_seconds");
}

TEST(TimeStep, KeepsExplicitViscosityStable) {
  TimeStepInputs inputs = stillWater();
  inputs.viscosity = 1;
  inputs.viscosityChoice = ViscosityChoice::Explicit;
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_DOUBLE_EQ(choice.seconds, 0.1 * 0.05 * 0.05);
  EXPECT_EQ(choice.limit, "viscosity");
}

TEST(TimeStep, ShortensUnderStrongForces) {
  TimeStepInputs inputs = stillWater();
  inputs.acceleration = 1000;
  EXPECT_EQ(chooseTimeStep({}, inputs).limit, "force");
}

TEST(TimeStep, StaysShortAfterAStepWasTakenBack) {
  TimeStepInputs inputs = stillWater();
  inputs.recovery = 0.001;
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_DOUBLE_EQ(choice.seconds, 0.001);
  EXPECT_EQ(choice.limit, "recovery");
}

TEST(TimeStep, LeavesLongViscousStepsToTheImplicitSolver) {
  TimeStepInputs inputs = stillWater();
  EXPECT_FALSE(chooseTimeStep({}, inputs).implicitViscosity);
  inputs.viscosity = 1;
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_TRUE(choice.implicitViscosity);
  EXPECT_EQ(choice.limit, "max_seconds");
  inputs.viscosity = 0.01;
  inputs.viscosityChoice = ViscosityChoice::Implicit;
  EXPECT_TRUE(chooseTimeStep({}, inputs).implicitViscosity);
}

TEST(TimeStep, KeepsCapillaryWavesStable) {
  TimeStepInputs inputs = stillWater();
  inputs.kinematicTension = 1;
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_NEAR(choice.seconds, 0.25 * std::sqrt(0.05 * 0.05 * 0.05 / (2 * std::numbers::pi)), 1e-12);
  EXPECT_EQ(choice.limit, "surface tension");
}

TEST(TimeStep, KeepsSoundWithinASmoothingLength) {
  TimeStepInputs inputs = stillWater();
  inputs.maxSpeed = 2;
  inputs.speedOfSound = 40;
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_DOUBLE_EQ(choice.seconds, 0.25 * 0.05 / 42);
  EXPECT_EQ(choice.limit, "sound");
}

}  // namespace
}  // namespace sluice::sim
