// A simulation that is saved and gone on with elsewhere makes the particles that it would have made by itself.

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"
#include "sluice/core/state_stream.h"

namespace sluice::sim {
namespace {

void resume(FluidSimulation& simulation, const std::vector<std::uint8_t>& bytes) {
  core::StateReader in(bytes, "state");
  simulation.resume(in);
  EXPECT_TRUE(in.atEnd());
}

std::string resumeError(FluidSimulation& simulation, const std::vector<std::uint8_t>& bytes) {
  try {
    resume(simulation, bytes);
  } catch (const core::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was taken";
  return {};
}

struct Case {
  const char* name;
  std::function<v1::Simulation()> settings;
  /// What the steps must have had something of for the case to be one.
  std::function<bool(const FluidSimulation&)> inUse = [](const FluidSimulation&) { return true; };
};

void PrintTo(const Case& kind, std::ostream* out) { *out << kind.name; }

v1::Simulation damBreakWith(const std::function<void(v1::Simulation&)>& change) {
  v1::Simulation settings = smallDamBreak();
  change(settings);
  return settings;
}

/// Particles that fly apart from each other and from the walls.
v1::Simulation scattered() {
  v1::Simulation settings = floatingCube(1);
  for (int i = 1; i < 5; ++i) {
    v1::Block* block = settings.mutable_fluids(0)->add_blocks();
    *block = settings.fluids(0).blocks(0);
    block->mutable_first_particle()->set_x(0.12 * i);
    block->mutable_velocity()->set_x(0.5 * i);
  }
  return settings;
}

/// A jet that begins after a while, into a pool with a drain: particles come and go.
v1::Simulation basinWith(const std::function<void(v1::Simulation&)>& change) {
  v1::Simulation settings = column(12, 3);
  v1::Fluid* fluid = settings.mutable_fluids(0);
  settings.mutable_container()->mutable_max()->set_y(0.8);
  v1::Emitter* emitter = fluid->add_emitters();
  emitter->mutable_position()->set_x(0.33);
  emitter->mutable_position()->set_y(0.6);
  emitter->mutable_position()->set_z(0.3);
  emitter->mutable_direction()->set_y(-1);
  emitter->set_radius(0.08);
  emitter->set_speed(2);
  emitter->set_start_seconds(0.003);
  v1::Box* drain = settings.add_drains()->mutable_box();
  drain->mutable_min();
  drain->mutable_max()->set_x(0.12);
  drain->mutable_max()->set_y(0.12);
  drain->mutable_max()->set_z(0.65);
  change(settings);
  return settings;
}

bool flows(const FluidSimulation& simulation) {
  return simulation.population().emitted() > 0 && simulation.population().state().drained > 10;
}

class Resumed : public testing::TestWithParam<Case> {};

TEST_P(Resumed, GoesOnBitForBit) {
  const v1::Simulation settings = GetParam().settings();
  FluidSimulation uninterrupted(settings, {.threads = 2});
  for (const int before : {0, 37, 60}) {
    while (uninterrupted.statistics().steps < static_cast<std::uint64_t>(before)) advance(uninterrupted, 1);
    const std::vector<std::uint8_t> bytes = saved(uninterrupted);
    FluidSimulation reference(settings, {.threads = 2});
    advance(reference, before + 40);

    FluidSimulation resumed(settings, {.threads = 1});
    advance(resumed, 3);
    resume(resumed, bytes);
    EXPECT_EQ(resumed.time(), uninterrupted.time());
    EXPECT_TRUE(resumed.state() == uninterrupted.state());
    EXPECT_EQ(saved(resumed), bytes);
    EXPECT_EQ(resumed.snapshot()->densities, uninterrupted.snapshot()->densities);
    EXPECT_EQ(resumed.snapshot()->neighbours, uninterrupted.snapshot()->neighbours);
    advance(resumed, 40);
    EXPECT_TRUE(resumed.state() == reference.state()) << "from step " << before;
    EXPECT_EQ(resumed.time(), reference.time());
    EXPECT_EQ(resumed.statistics().steps, reference.statistics().steps);
    EXPECT_EQ(resumed.statistics().maxDensityError, reference.statistics().maxDensityError);
    EXPECT_EQ(resumed.wallContacts(), reference.wallContacts());
    if (before > 0) {
      EXPECT_TRUE(GetParam().inUse(resumed));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod, Resumed,
    testing::Values(
        Case{"dfsph", smallDamBreak,
             [](const FluidSimulation& s) { return s.statistics().divergenceIterations > 0 && s.wallContacts() > 0; }},
        Case{"iisph", [] { return damBreakWith([](auto& s) { s.mutable_iisph(); }); },
             [](const FluidSimulation& s) { return s.statistics().densityIterations > 0; }},
        Case{"pbf", [] { return damBreakWith([](auto& s) { s.mutable_pbf(); }); },
             [](const FluidSimulation& s) { return s.statistics().densityIterations > 0; }},
        Case{"wcsph", [] { return damBreakWith([](auto& s) { s.mutable_wcsph()->mutable_density_diffusion(); }); },
             [](const FluidSimulation& s) { return !s.state().compression.empty(); }},
        Case{"two_fluids", [] { return layeredTank(1000, 700); },
             [](const FluidSimulation& s) { return !s.state().fluid.empty(); }},
        Case{"implicit_viscosity",
             [] {
               return damBreakWith([](auto& s) {
                 s.mutable_fluids(0)->set_viscosity(2);
                 s.mutable_implicit_viscosity();
               });
             },
             [](const FluidSimulation& s) { return s.statistics().viscosityIterations > 0; }},
        Case{"tension_and_spin",
             [] {
               return damBreakWith([](auto& s) {
                 s.mutable_surface_tension()->set_tension(0.5);
                 s.mutable_micropolar()->set_transfer(0.1);
               });
             },
             [](const FluidSimulation& s) { return !s.state().spin.empty(); }},
        Case{"flow_dfsph", [] { return basinWith([](auto&) {}); }, flows},
        Case{"flow_pbf", [] { return basinWith([](auto& s) { s.mutable_pbf(); }); }, flows},
        Case{"flow_wcsph_spin_two_fluids",
             [] {
               return basinWith([](auto& s) {
                 s.mutable_wcsph();
                 s.mutable_micropolar();
                 v1::Fluid* other = s.add_fluids();
                 *other = s.fluids(0);
                 other->clear_blocks();
                 other->mutable_emitters(0)->mutable_position()->set_x(0.53);
               });
             },
             flows},
        Case{"free_flight", scattered,
             [](const FluidSimulation& s) {
               const core::Plan plan = s.plan();
               return std::ranges::any_of(plan.leftOut, [](const auto& left) { return left.name == "neighbours"; });
             }}),
    [](const auto& tested) { return tested.param.name; });

TEST(SavedState, GoesOnAfterAStepThatWasTakenBack) {
  // A long step squeezes the fluid too far; the shorter ones that follow grow back slowly.
  v1::Simulation settings = smallDamBreak();
  settings.mutable_time_step()->set_cfl(1);
  settings.mutable_dfsph()->set_max_iterations(2);
  settings.mutable_time_step()->set_max_compression(3);
  FluidSimulation simulation(settings);
  while (simulation.statistics().timeStepLimit != "recovery") advance(simulation, 1);
  FluidSimulation resumed(settings);
  resume(resumed, saved(simulation));
  advance(simulation, 20);
  advance(resumed, 20);
  EXPECT_TRUE(resumed.state() == simulation.state());
}

TEST(SavedState, IsRefusedByAnotherScene) {
  const std::vector<std::uint8_t> bytes = saved(FluidSimulation(smallDamBreak()));
  FluidSimulation fewer(floatingCube(5));
  EXPECT_THAT(resumeError(fewer, bytes), testing::HasSubstr("not those of the state's scene"));
  FluidSimulation other(damBreakWith([](auto& s) { s.mutable_wcsph(); }));
  EXPECT_THAT(resumeError(other, bytes), testing::HasSubstr("not those of the state's scene"));
}

TEST(SavedState, OfAFlowIsRefusedByASceneWithAnotherNumberOfNozzles) {
  const std::vector<std::uint8_t> bytes = saved(FluidSimulation(basinWith([](auto&) {})));
  FluidSimulation other(basinWith([](auto& s) {
    *s.mutable_fluids(0)->add_emitters() = s.fluids(0).emitters(0);
    s.mutable_fluids(0)->mutable_emitters(1)->mutable_position()->set_x(0.53);
  }));
  EXPECT_THAT(resumeError(other, bytes), testing::HasSubstr("emitters and drains"));
}

TEST(SavedState, IsRefusedWhenCutOffAnywhere) {
  const std::vector<std::uint8_t> bytes = saved(FluidSimulation(floatingCube(4)));
  FluidSimulation simulation(floatingCube(4));
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    const std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THROW(resume(simulation, cut), core::InputError) << length;
  }
}

TEST(Stop, IsReachedExactlyAndShortensNoOtherStep) {
  FluidSimulation simulation(smallDamBreak());
  advance(simulation, 30);
  const double usual = simulation.statistics().timeStepSeconds;
  for (int frame = 1; frame <= 5; ++frame) {
    const double stop = simulation.time() + 0.013 * frame;
    simulation.stopAt(stop);
    double shortest = usual;
    while (simulation.time() < stop) {
      advance(simulation, 1);
      shortest = std::min(shortest, simulation.statistics().timeStepSeconds);
    }
    EXPECT_EQ(simulation.time(), stop);
    EXPECT_GT(shortest, 0.2 * usual) << "nothing is left over for a last tiny step";
  }
}

TEST(Stop, InThePastOrFarAwayChangesNothing) {
  FluidSimulation free(smallDamBreak());
  FluidSimulation stopped(smallDamBreak());
  advance(free, 40);
  stopped.stopAt(1e6);
  advance(stopped, 20);
  stopped.stopAt(0);
  advance(stopped, 20);
  EXPECT_TRUE(stopped.state() == free.state());
  EXPECT_EQ(stopped.time(), free.time());
}

TEST(Stop, MayBeNearerThanTheShortestStep) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_time_step()->set_min_seconds(1e-4);
  FluidSimulation simulation(settings);
  simulation.stopAt(1e-5);
  advance(simulation, 1);
  EXPECT_EQ(simulation.time(), 1e-5);
  EXPECT_EQ(simulation.statistics().timeStepLimit, "frame");
}

}  // namespace
}  // namespace sluice::sim
