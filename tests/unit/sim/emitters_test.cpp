// Particles that come out of nozzles and leave by drains.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

using testing::Contains;
using testing::HasSubstr;

// In steps short and long against the time from one layer to the next.
TEST(Emitter, GivesExactlyMouthAreaTimesSpeed) {
  for (const double radius : {0.03, 0.062, 0.13}) {
    for (const double longest : {0.0007, 0.004, 0.03}) {
      v1::Simulation settings = jet(radius, 1.3);
      settings.mutable_time_step()->set_max_seconds(longest);
      settings.mutable_time_step()->set_cfl(1);
      FluidSimulation simulation(settings);
      const double perLayer = std::numbers::pi * radius * radius / (kSpacing * kSpacing);
      while (simulation.time() < 1.2) {
        ASSERT_TRUE(simulation.advance()) << simulation.halted();
        const double expected = perLayer * 1.3 * simulation.time() / kSpacing;
        ASSERT_NEAR(static_cast<double>(simulation.state().size()), expected, perLayer + 1)
            << radius << " m, at " << simulation.time() << " s";
      }
    }
  }
}

TEST(Emitter, LeavesNoGapsInTheJetWhateverTheStep) {
  for (const double longest : {0.001, 0.02, 0.1}) {
    v1::Simulation settings = jet(0.03, 1);
    settings.mutable_time_step()->set_max_seconds(longest);
    settings.mutable_time_step()->set_cfl(1);
    FluidSimulation simulation(settings);
    simulation.stopAt(1.013);
    runUntil(simulation, 1.013);
    std::vector<double> along;
    for (const Float4& x : simulation.state().position) along.push_back(x.x - 0.3);
    std::ranges::sort(along);
    EXPECT_NEAR(along.front(), 1.013 - 0.05 * std::floor(1.013 / 0.05), 1e-5);
    EXPECT_NEAR(along.back(), 1.013, 0.01);
    for (std::size_t k = 1; k < along.size(); ++k) EXPECT_LT(along[k] - along[k - 1], 1.05 * kSpacing);
  }
}

TEST(Emitter, TooNearTheFaceOfARoundContainerIsRefused) {
  v1::Simulation settings = jet(0.1, 1);
  v1::RoundContainer* sphere = settings.mutable_spherical_container();
  set(sphere->mutable_centre(), 0, 0, 0);
  sphere->set_radius(1.5);
  EXPECT_NO_THROW(FluidSimulation{settings});
  set(emitterOf(settings).mutable_position(), -1.2, 1.2, 0);  // inside of the box around, outside of the sphere
  expectRefused(settings, "simulation.fluids[0].emitters[0].position", "inside the container and its planes");
}

TEST(Emitter, JetFallsOnTheParabolaOfItsThrow) {
  // A layer is one particle, but for one in a hundred.
  v1::Simulation settings = jet(0.0283, 2);
  settings.mutable_gravity()->set_y(-9.81);
  settings.mutable_fluids(0)->set_viscosity(0);  // would hold the head of the jet back
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.5);
  int free = 0;
  for (const Float4& x : simulation.state().position) {
    const double thrown = (x.x - 0.3) / 2;
    const double expected = 1.5 - 0.5 * 9.81 * thrown * thrown;
    if (expected < 0.2) continue;  // Where the floor is near.
    free += thrown > 0.1 ? 1 : 0;
    EXPECT_NEAR(x.y, expected, 0.25 * kSpacing) << "after " << thrown << " s";
    EXPECT_NEAR(x.z, 1.5, 0.1 * kSpacing);
  }
  EXPECT_GT(free, 10);
}

TEST(Emitter, ALayerIsWithinTheMouthAndEvenlySpread) {
  const FluidSimulation simulation(jet(0.3, 1));
  const std::vector<Float4>& places = simulation.state().position;
  EXPECT_NEAR(static_cast<double>(places.size()), std::numbers::pi * 36, 1);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_FLOAT_EQ(places[i].x, 0.3F);
    EXPECT_LT(std::hypot(places[i].y - 1.5, places[i].z - 1.5), 0.3 + 0.5 * kSpacing);
    double closest = 1;
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (j != i)
        closest = std::min(closest, std::hypot(double{places[i].y} - places[j].y, double{places[i].z} - places[j].z));
    }
    EXPECT_NEAR(closest, kSpacing * std::sqrt(2 / std::numbers::sqrt3), 1e-5);
  }
}

TEST(Emitter, BeginsAndEndsInItsTime) {
  v1::Simulation settings = jet(0.06, 1);
  emitterOf(settings).set_start_seconds(0.21);
  emitterOf(settings).set_end_seconds(0.43);
  FluidSimulation simulation(settings, {.threads = 2});
  EXPECT_EQ(simulation.state().size(), 0U);
  EXPECT_EQ(simulation.snapshot()->size(), 0U);
  while (simulation.time() < 0.7) {
    ASSERT_TRUE(simulation.advance());
    EXPECT_EQ(simulation.state().size() > 0, simulation.time() >= 0.21) << simulation.time();
  }
  // Layers at 0.21, 0.26, 0.31, 0.36, 0.41 s.
  EXPECT_NEAR(static_cast<double>(simulation.state().size()), 5 * std::numbers::pi * 1.44, 0.5);
  EXPECT_THAT(simulation.plan().leftOut, Contains(core::LeftOut{"emitters", "all have ended"}));
}

TEST(Emitter, GivesNoMoreThanItsOwnMost) {
  v1::Simulation settings = jet(0.06, 1);
  emitterOf(settings).set_max_particles(7);
  FluidSimulation simulation(settings);
  runUntil(simulation, 0.4);
  EXPECT_EQ(simulation.state().size(), 7U);
}

TEST(Emitter, RestsWhileTheBudgetIsUsedUp) {
  v1::Simulation settings = jet(0.06, 1);
  settings.set_max_particles(30);
  addDrain(settings, {0, -1.5, -1.5}, {1.5, 1.5, 1.5});
  FluidSimulation simulation(settings);
  std::size_t most = 0;
  while (simulation.time() < 3) {
    ASSERT_TRUE(simulation.advance());
    most = std::max(most, simulation.state().size());
  }
  EXPECT_LE(most, 30U);
  EXPECT_GT(most, 25U);
  EXPECT_GT(simulation.population().emitted(), 45U) << "goes on when particles have left";
  v1::Scene scene = sceneOf(settings);
  scene.mutable_simulation()->set_max_particles(200);
  simulation.update(scene);
  runUntil(simulation, 4.5);
  EXPECT_GT(simulation.state().size(), 60U);
}

TEST(Emitter, RestsWhereMemoryEndsAndSaysSo) {
  v1::Simulation settings = jet(0.06, 1);
  FluidSimulation simulation(settings, {.availableMemory = 40000});
  EXPECT_THAT(simulation.notices(), testing::ElementsAre(HasSubstr("emitters rest while there are")));
  runUntil(simulation, 2);
  EXPECT_LT(simulation.state().size(), 60U);
  EXPECT_THAT(FluidSimulation(settings).notices(), testing::IsEmpty());
}

TEST(Emitter, WaitsUntilThereIsRoom) {
  v1::Simulation settings = jet(0.06, 1);
  // A wall of fluid at rest in the mouth, which nothing moves away.
  v1::Block* block = settings.mutable_fluids(0)->add_blocks();
  set(block->mutable_first_particle(), -1.25, -0.2, -0.2);
  block->set_count_x(3);
  block->set_count_y(9);
  block->set_count_z(9);
  FluidSimulation blocked(settings);
  runUntil(blocked, 0.3);
  EXPECT_EQ(blocked.state().size(), 243U);
  // That moves away.
  block->mutable_velocity()->set_x(2);
  FluidSimulation freed(settings);
  EXPECT_EQ(freed.state().size(), 243U);
  runUntil(freed, 0.3);
  EXPECT_GT(freed.state().size(), 260U);
}

TEST(Emitter, NeverEmitsIntoOtherParticles) {
  v1::Simulation settings = basin();
  // Another in nearly the same place, and one under water.
  for (const double height : {0.98, 0.3}) {
    v1::Emitter* other = settings.mutable_fluids(0)->add_emitters();
    *other = settings.fluids(0).emitters(0);
    other->mutable_position()->set_y(height);
  }
  emitterOf(settings).mutable_direction()->set_x(0);
  FluidSimulation simulation(settings);
  int layers = 0;
  while (simulation.time() < 0.4) {
    const std::uint64_t former = simulation.population().state().nextId;
    ASSERT_TRUE(simulation.advance());
    const ParticleState& state = simulation.state();
    layers += simulation.population().state().nextId > former ? 1 : 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      if (state.id[i] < former) continue;
      const Float4& a = state.position[i];
      for (std::size_t j = 0; j < state.size(); ++j) {
        const Float4& b = state.position[j];
        const double distance = std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
        ASSERT_TRUE(i == j || distance > 0.74 * kSpacing) << distance << " m, at " << simulation.time() << " s";
      }
    }
  }
  EXPECT_GT(layers, 10);
}

TEST(Nozzle, ThatIsNoneIsRefused) {
  v1::Simulation settings = jet(0.02, 1);
  expectRefused(settings, "simulation.fluids[0].emitters[0].radius", "at least 0.0282095 m");
  settings = jet(0.06, 1);
  emitterOf(settings).set_start_seconds(2);
  emitterOf(settings).set_end_seconds(1);
  expectRefused(settings, "simulation.fluids[0].emitters[0].end_seconds", "before start_seconds");
  settings = jet(0.06, 1);
  emitterOf(settings).mutable_position()->set_x(-1.49);
  expectRefused(settings, "simulation.fluids[0].emitters[0].position", "within [-1.45, 1.45] m");
  emitterOf(settings).mutable_position()->set_x(1.4);
  expectRefused(settings, "simulation.fluids[0].emitters[0].position", "the mouth");
}

TEST(Nozzle, InsideABodyIsRefused) {
  Bodies::List bodies;
  v1::Body* sphere = bodies.Add();
  sphere->mutable_sphere()->set_radius(0.3);
  sphere->mutable_position()->set_x(-1.1);
  try {
    const FluidSimulation simulation(jet(0.06, 1), bodies);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "simulation.fluids[0].emitters[0].position");
    EXPECT_THAT(error.problem(), HasSubstr("inside bodies[0]"));
  }
}

TEST(Nozzle, IsASlitInAPlanarScene) {
  v1::Simulation settings = jet(0.11, 1);
  settings.set_planar(true);
  FluidSimulation simulation(settings);
  runUntil(simulation, 1);
  EXPECT_NEAR(static_cast<double>(simulation.state().size()), 1 * 0.22 / (kSpacing * kSpacing), 6);
  emitterOf(settings).mutable_direction()->set_z(0.5);
  expectRefused(settings, "simulation.fluids[0].emitters[0].direction.z", "planar");
}

}  // namespace
}  // namespace sluice::sim
