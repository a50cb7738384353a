// Hands that add fluid: where the ball stands, what it is made of, with every method.

#include "added_ball.h"

#include <cmath>
#include <functional>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hands.h"
#include "scenes.h"
#include "sluice/core/state_stream.h"

namespace sluice::sim {
namespace {

using core::Interaction;
using testing::HasSubstr;

v1::Simulation tankWith(const std::function<void(v1::Simulation&)>& change) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_container()->mutable_max()->set_y(1.6);
  change(settings);
  return settings;
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

}  // namespace
}  // namespace sluice::sim
