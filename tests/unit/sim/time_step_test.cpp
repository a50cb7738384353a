#include "time_step.h"

#include <gtest/gtest.h>

namespace sluice::sim {
namespace {

TimeStepInputs stillWater() {
  return {.spacing = 0.05, .support = 0.1, .maxSpeed = 0, .gravity = 9.81, .viscosity = 0.01};
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
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_DOUBLE_EQ(choice.seconds, 0.125 * 0.05 * 0.05);
  EXPECT_EQ(choice.limit, "viscosity");
}

TEST(TimeStep, ShortensUnderStrongGravity) {
  TimeStepInputs inputs = stillWater();
  inputs.gravity = 1000;
  EXPECT_EQ(chooseTimeStep({}, inputs).limit, "gravity");
}

TEST(TimeStep, StaysShortAfterAStepWasTakenBack) {
  TimeStepInputs inputs = stillWater();
  inputs.recovery = 0.001;
  const TimeStepChoice choice = chooseTimeStep({}, inputs);
  EXPECT_DOUBLE_EQ(choice.seconds, 0.001);
  EXPECT_EQ(choice.limit, "recovery");
}

}  // namespace
}  // namespace sluice::sim
