// Hands in the fluid: pushing and pulling it.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hands.h"
#include "scenes.h"
#include "touch.h"

namespace sluice::sim {
namespace {

using core::Interaction;
using Eigen::Vector3d;
using testing::HasSubstr;

/// Σ v, m/s.
Vector3d velocitySum(const FluidSimulation& simulation) {
  Vector3d sum = Vector3d::Zero();
  for (const Float4& v : simulation.state().velocity) sum += Vector3d(v.x, v.y, v.z);
  return sum;
}

TEST(Touch, PushGivesItsWeightedAccelerationForExactlyItsTime) {
  FluidSimulation simulation(floatingCube(6), {.threads = 2});
  Interaction push = touchOf(Interaction::Action::Push, {-4, 0.03, 0.01}, {1, 0, 0});
  push.radius = 0.12;
  push.strength = 3;
  push.seconds = 0.0137;  // No whole number of steps.
  double expected = 0;
  for (const Float4& x : simulation.state().position) {
    const double square = (std::pow(x.y - 5 - 0.03, 2) + std::pow(x.z - 5 - 0.01, 2)) / (0.12 * 0.12);
    if (square < 1) expected += 3 * 0.0137 * (1 - square) * (1 - square);
  }
  ASSERT_GT(expected, 0);
  simulation.interact(push);
  while (simulation.time() < 0.03) advance(simulation, 1);
  // Pressure pushes back and forth between particles, which move by less than a thousandth of the reach meanwhile.
  const Vector3d sum = velocitySum(simulation);
  EXPECT_NEAR(sum.x(), expected, 0.01 * expected);
  EXPECT_NEAR(sum.y(), 0, 1e-4 * expected);
  EXPECT_NEAR(sum.z(), 0, 1e-4 * expected);
}

TEST(Touch, ForceEndsWithinAStep) {
  ParticleState one;
  one.position.push_back({1, 1, 1, 0});
  one.velocity.push_back({});
  Touch touch(0.05);
  touch.add(
      {.origin = {0, 1, 1}, .direction = {1, 0, 0}, .aim = {0, 1, 0}, .radius = 1, .acceleration = 8, .end = 0.5});
  const Team team(1);
  const Vector3d whole = touch.apply(one, 0, 0.25, {1000}, team);
  EXPECT_EQ(one.velocity[0], (Float4{0, 2, 0, 0}));
  EXPECT_DOUBLE_EQ(whole.y(), 2000);
  EXPECT_TRUE(touch.isActive(0.4375));
  touch.apply(one, 0.4375, 0.75, {1000}, team);
  EXPECT_EQ(one.velocity[0], (Float4{0, 2.5F, 0, 0}));
  EXPECT_FALSE(touch.isActive(0.5));
  touch.apply(one, 0.5, 1, {1000}, team);
  EXPECT_EQ(one.velocity[0], (Float4{0, 2.5F, 0, 0}));
}

TEST(Touch, ReachesNothingBehindTheRayAndBesideIt) {
  ParticleState particles;
  particles.position = {{-0.2F, 0, 0, 0}, {0.5F, 0.2F, 0, 0}, {0.5F, 0.05F, 0, 0}};
  particles.velocity.resize(3);
  Touch touch(0.05);
  touch.add(
      {.origin = {0, 0, 0}, .direction = {1, 0, 0}, .aim = {1, 0, 0}, .radius = 0.1, .acceleration = 1, .end = 1});
  touch.apply(particles, 0, 1, {1000}, Team(1));
  EXPECT_EQ(particles.velocity[0], Float4{});
  EXPECT_EQ(particles.velocity[1], Float4{});
  EXPECT_FLOAT_EQ(particles.velocity[2].x, 0.75F * 0.75F);
}

TEST(Touch, PullDrawsTowardsWhereTheRayMeetsFluid) {
  FluidSimulation simulation(floatingCube(8), {.threads = 1});
  Interaction pull = touchOf(Interaction::Action::Pull, {0, 4, 0}, {0, -1, 0});
  pull.radius = 1;
  simulation.interact(pull);
  advance(simulation, 1);
  // The cube's top is at 0.175 m: most is below the target and comes up, what is beside it comes inwards.
  EXPECT_GT(velocitySum(simulation).y(), 0);
  double inwards = 0;
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    const Float4& x = simulation.state().position[i];
    const Float4& v = simulation.state().velocity[i];
    inwards -= (x.x - 5) * v.x + (x.z - 5) * v.z;
  }
  EXPECT_GT(inwards, 0);
}

TEST(Touch, IsPlannedOnlyWhileAHandActs) {
  FluidSimulation simulation(smallDamBreak(), {.threads = 1});
  const auto planned = [&] {
    const core::Plan plan = simulation.plan();
    return std::ranges::any_of(plan.stages, [](const core::PlannedStage& stage) { return stage.name == "touch"; });
  };
  EXPECT_FALSE(planned());
  EXPECT_THAT(simulation.plan().leftOut, testing::Contains(core::LeftOut{"touch", "nobody touches the fluid"}));
  Interaction push = downInto(Interaction::Action::Push);
  push.seconds = 0.01;
  simulation.interact(push);
  EXPECT_TRUE(planned());
  while (simulation.time() < 0.01) advance(simulation, 1);
  EXPECT_FALSE(planned());
}

TEST(Touch, StageWithoutAHandChangesNothing) {
  FluidSimulation lean(smallDamBreak(), {.threads = 1});
  FluidSimulation full(smallDamBreak(), {.threads = 1, .keepInertStages = true});
  advance(lean, 15);
  advance(full, 15);
  EXPECT_TRUE(lean.state() == full.state());
}

TEST(Touch, BoundsTheTimeStep) {
  FluidSimulation simulation(smallDamBreak(), {.threads = 1});
  Interaction push = downInto(Interaction::Action::Push);
  push.strength = 5000;
  simulation.interact(push);
  advance(simulation, 1);
  EXPECT_EQ(simulation.statistics().timeStepLimit, "force");
  // 0.25 √(h/a), with h a spacing.
  EXPECT_NEAR(simulation.statistics().timeStepSeconds, 0.25 * std::sqrt(kSpacing / 5009.81), 1e-8);
}

TEST(Touch, SameBitsForAnyNumberOfThreads) {
  const auto touched = [](int threads) {
    FluidSimulation simulation(smallDamBreak(), {.threads = threads});
    advance(simulation, 5);
    simulation.interact(downInto(Interaction::Action::Push));
    advance(simulation, 5);
    simulation.interact(downInto(Interaction::Action::Pull));
    simulation.interact(downInto(Interaction::Action::Add));
    advance(simulation, 20);
    return simulation.state();
  };
  const ParticleState one = touched(1);
  EXPECT_GT(one.size(), 3000U);
  for (const int threads : {2, 4}) EXPECT_TRUE(touched(threads) == one) << threads << " threads";
}

TEST(Touch, ResetForgetsHandsAndWhatTheyAdded) {
  FluidSimulation simulation(smallDamBreak(), {.threads = 2});
  const std::vector<std::uint8_t> initial = saved(simulation);
  simulation.interact(downInto(Interaction::Action::Push));
  simulation.interact(downInto(Interaction::Action::Add));
  advance(simulation, 3);
  simulation.reset();
  EXPECT_EQ(saved(simulation), initial);
}

TEST(Interact, RefusesWhatCannotBeDoneAndSaysWhy) {
  v1::Simulation settings = smallDamBreak();
  settings.set_max_particles(3050);
  FluidSimulation simulation(settings, {.threads = 1});
  Interaction add = downInto(Interaction::Action::Add);
  EXPECT_THAT(refusal(simulation, add), HasSubstr("leaves room for 50"));
  add.fluid = 1;
  EXPECT_THAT(refusal(simulation, add), HasSubstr("interact.fluid"));
  add = downInto(Interaction::Action::Add);
  add.radius = 10;
  EXPECT_THAT(refusal(simulation, add), HasSubstr("interact.radius"));
  // A ball that is no more than one place, which is in a wall.
  add = touchOf(Interaction::Action::Add, {1.2, 0.0005, 3}, {0, 0, -1});
  add.radius = 0.01;
  EXPECT_THAT(refusal(simulation, add), HasSubstr("no particle fits"));
  EXPECT_THAT(refusal(simulation, touchOf(Interaction::Action::Add, {0, 5, 0}, {1, 0, 0})), HasSubstr("container"));
  EXPECT_THAT(refusal(simulation, touchOf(Interaction::Action::Pull, {1.2, 3, 0.4}, {0, -1, 0})),
              HasSubstr("no fluid"));
  Interaction push = downInto(Interaction::Action::Push);
  push.strength = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(simulation, push), HasSubstr("interact.strength"));
  push.strength = 1;
  for (int touches = 0; touches < 64; ++touches) simulation.interact(push);
  EXPECT_THAT(refusal(simulation, push), HasSubstr("64 touches"));
}

}  // namespace
}  // namespace sluice::sim
