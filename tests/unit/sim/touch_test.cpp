// Hands in the fluid: pushing and pulling it, and adding some.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "added_ball.h"
#include "scenes.h"
#include "sluice/core/input_error.h"
#include "sluice/core/state_stream.h"
#include "touch.h"

namespace sluice::sim {
namespace {

using core::Interaction;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kSpacing = 0.05;

Interaction touchOf(Interaction::Action action, const Vector3d& origin, const Vector3d& direction) {
  return {.action = action, .origin = origin, .direction = direction.normalized()};
}

/// Straight down into the middle of smallDamBreak's block.
Interaction downInto(Interaction::Action action) { return touchOf(action, {0.3, 3, 0.4}, {0, -1, 0}); }

std::string refusal(FluidSimulation& simulation, const Interaction& interaction) {
  const ParticleState before = simulation.state();
  try {
    simulation.interact(interaction);
  } catch (const core::InputError& error) {
    EXPECT_TRUE(simulation.state() == before);
    return error.what();
  }
  ADD_FAILURE() << "was done";
  return {};
}

void advance(FluidSimulation& simulation, int steps) {
  for (int step = 0; step < steps; ++step) ASSERT_TRUE(simulation.advance()) << simulation.halted();
}

/// Σ v, m/s.
Vector3d velocitySum(const FluidSimulation& simulation) {
  Vector3d sum = Vector3d::Zero();
  for (const Float4& v : simulation.state().velocity) sum += Vector3d(v.x, v.y, v.z);
  return sum;
}

std::vector<std::uint8_t> saved(const FluidSimulation& simulation) {
  core::StateWriter out;
  simulation.save(out);
  return out.bytes();
}

v1::Simulation tankWith(const std::function<void(v1::Simulation&)>& change) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_container()->mutable_max()->set_y(1.6);
  change(settings);
  return settings;
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

struct Case {
  const char* name;
  std::function<void(v1::Simulation&)> change;
  std::uint32_t fluid = 0;
};

void PrintTo(const Case& kind, std::ostream* out) { *out << kind.name; }

class TouchedScene : public testing::TestWithParam<Case> {};

TEST_P(TouchedScene, GoesOnBitForBitFromASavedState) {
  const v1::Simulation settings = tankWith(GetParam().change);
  FluidSimulation uninterrupted(settings, {.threads = 2});
  advance(uninterrupted, 4);
  Interaction add = downInto(Interaction::Action::Add);
  add.fluid = GetParam().fluid;
  uninterrupted.interact(add);
  uninterrupted.interact(downInto(Interaction::Action::Push));
  advance(uninterrupted, 2);
  const std::vector<std::uint8_t> bytes = saved(uninterrupted);

  FluidSimulation resumed(settings, {.threads = 1});
  core::StateReader in(bytes, "state");
  resumed.resume(in);
  EXPECT_TRUE(in.atEnd());
  EXPECT_EQ(saved(resumed), bytes);
  EXPECT_EQ(resumed.snapshot()->ages, uninterrupted.snapshot()->ages);
  advance(uninterrupted, 25);
  advance(resumed, 25);
  EXPECT_TRUE(resumed.state() == uninterrupted.state());
  EXPECT_EQ(resumed.time(), uninterrupted.time());
}

TEST_P(TouchedScene, AddsParticlesOfItsFluidThatKeepTheirDistance) {
  FluidSimulation simulation(tankWith(GetParam().change), {.threads = 2});
  advance(simulation, 4);
  const std::uint64_t next = simulation.population().state().nextId;
  const std::size_t before = simulation.state().size();
  const double time = simulation.time();
  Interaction add = downInto(Interaction::Action::Add);
  add.radius = 0.155;  // 123 places of a lattice.
  add.fluid = GetParam().fluid;
  simulation.interact(add);
  const ParticleState& state = simulation.state();
  const std::size_t added = state.size() - before;
  EXPECT_GT(added, 80U);
  EXPECT_LE(added, 123U);

  state.forEachArray(
      state, [&](const auto& values, const auto&) { EXPECT_TRUE(values.empty() || values.size() == state.size()); });
  std::set<std::uint32_t> ids(state.id.begin(), state.id.end());
  EXPECT_EQ(ids.size(), state.size());
  const auto snapshot = simulation.snapshot();
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (state.id[i] < next) continue;
    EXPECT_LT(state.id[i], next + added);
    EXPECT_EQ(snapshot->ages[i], 0);
    EXPECT_EQ(state.velocity[i], Float4{});
    EXPECT_EQ(state.fluid.empty() ? 0U : state.fluid[i], GetParam().fluid);
    for (std::size_t j = 0; j < state.size(); ++j) {
      if (i == j) continue;
      const Float4& a = state.position[i];
      const Float4& b = state.position[j];
      EXPECT_GE(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.899 * kSpacing);
    }
  }
  advance(simulation, 20);
  const auto later = simulation.snapshot();
  for (std::size_t i = 0; i < later->size(); ++i) {
    const bool isNew = later->ids[i] >= next && later->ids[i] < next + added;
    if (!isNew) continue;
    EXPECT_FLOAT_EQ(later->ages[i], static_cast<float>(simulation.time() - time));
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, TouchedScene,
                         testing::Values(Case{"dfsph", [](v1::Simulation&) {}},
                                         Case{"iisph", [](auto& s) { s.mutable_iisph(); }},
                                         Case{"pbf", [](auto& s) { s.mutable_pbf(); }},
                                         Case{"wcsph", [](auto& s) { s.mutable_wcsph()->mutable_density_diffusion(); }},
                                         Case{"micropolar_implicit",
                                              [](auto& s) {
                                                s.mutable_micropolar()->set_transfer(0.1);
                                                s.mutable_fluids(0)->set_viscosity(2);
                                                s.mutable_implicit_viscosity();
                                              }},
                                         Case{"two_fluids",
                                              [](auto& s) {
                                                v1::Block other = s.fluids(0).blocks(0);
                                                other.mutable_first_particle()->set_x(1.05);
                                                addFluid(s, 700, 0.01, other);
                                              },
                                              1},
                                         Case{"emitter",
                                              [](auto& s) {
                                                v1::Emitter* emitter = s.mutable_fluids(0)->add_emitters();
                                                emitter->mutable_position()->set_x(1.2);
                                                emitter->mutable_position()->set_y(0.9);
                                                emitter->mutable_position()->set_z(0.4);
                                                emitter->mutable_direction()->set_y(-1);
                                                emitter->set_radius(0.08);
                                                emitter->set_speed(2);
                                              }}),
                         [](const auto& tested) { return tested.param.name; });

TEST(AddedBall, StandsBeforeAWallWhereTheRayMeetsNoFluid) {
  FluidSimulation simulation(smallDamBreak(), {.threads = 1});
  Interaction add = touchOf(Interaction::Action::Add, {1.2, 3, 0.4}, {0, -1, 0});
  add.radius = 0.155;
  simulation.interact(add);
  EXPECT_EQ(simulation.state().size(), 3000U + 123U);
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    if (simulation.state().id[i] < 3000) continue;
    EXPECT_GE(simulation.state().position[i].y, 0.99F * 0.05F);
    EXPECT_LE(simulation.state().position[i].y, 0.05F + 0.32F);
  }
}

TEST(AddedBall, StandsBeforeABody) {
  v1::Scene scene = sceneOf(smallDamBreak());
  v1::Body* body = scene.add_bodies();
  body->mutable_sphere()->set_radius(0.2);
  body->mutable_position()->set_x(1.2);
  body->mutable_position()->set_y(0.4);
  body->mutable_position()->set_z(0.4);
  FluidSimulation simulation(scene.simulation(), scene.bodies(), {.threads = 1});
  Interaction add = touchOf(Interaction::Action::Add, {1.2, 3, 0.4}, {0, -1, 0});
  add.radius = 0.1;
  simulation.interact(add);
  ASSERT_EQ(simulation.state().size(), 3000U + 33U);
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    if (simulation.state().id[i] < 3000) continue;
    const Float4& x = simulation.state().position[i];
    EXPECT_GE(std::hypot(x.x - 1.2, x.y - 0.4, x.z - 0.4), 0.2 + 0.9 * kSpacing);
    EXPECT_GT(x.y, 0.6F);
  }
}

TEST(AddedBall, IsADiscWhereTheRayPassesThroughAPlanarScene) {
  v1::Simulation settings = smallDamBreak();
  settings.set_planar(true);
  settings.mutable_fluids(0)->mutable_blocks(0)->set_count_z(1);
  settings.mutable_fluids(0)->mutable_blocks(0)->mutable_first_particle()->set_z(0.1);
  FluidSimulation simulation(settings, {.threads = 1});
  const std::size_t before = simulation.state().size();
  Interaction add = touchOf(Interaction::Action::Add, {1.1, 0.6, 3}, {0, 0, -1});
  add.radius = 0.11;
  simulation.interact(add);
  EXPECT_EQ(simulation.state().size(), before + 13);
  for (const Float4& x : simulation.state().position) EXPECT_FLOAT_EQ(x.z, 0.1F);
  // Seen from the front, a push has no direction; from the side it has.
  EXPECT_THAT(refusal(simulation, touchOf(Interaction::Action::Push, {0.3, 0.5, 3}, {0, 0, -1})),
              HasSubstr("interact.direction"));
  simulation.interact(touchOf(Interaction::Action::Push, {0.3, 0.5, 3}, {0.1, 0, -1}));
  simulation.interact(touchOf(Interaction::Action::Pull, {0.3, 0.5, 3}, {0, 0, -1}));
  advance(simulation, 10);
  for (const Float4& x : simulation.state().position) EXPECT_FLOAT_EQ(x.z, 0.1F);
}

TEST(AddedBall, LeavesPlacesNearFluidAndWallsOut) {
  Container container;
  container.size = {1, 1, 1};
  const Team team(1);
  const std::vector<Float4> fluid{{0.5F, 0.5F, 0.5F, 0}};
  const AddedBall middle{{0.5, 0.5, 0.5}, 0.1, 0.1};
  const BallPlaces besideFluid = placesOf(middle, {container, {}, fluid}, team);
  EXPECT_EQ(besideFluid.free.size(), 6U);
  EXPECT_EQ(besideFluid.byFluid, 1U);
  const BallPlaces atWall = placesOf({{0.5, 0.1, 0.5}, 0.1, 0.1}, {container, {}, {}}, team);
  EXPECT_EQ(atWall.free.size(), 6U);
  EXPECT_EQ(atWall.bySolids, 1U);
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
