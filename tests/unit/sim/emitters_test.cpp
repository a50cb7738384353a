// Particles that come out of nozzles and leave by drains.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kSpacing = 0.05;

void set(v1::Vec3* v, double x, double y, double z) {
  v->set_x(x);
  v->set_y(y);
  v->set_z(z);
}

/// An empty container of 3 m about the origin, without gravity, with a nozzle that points along x.
v1::Simulation jet(double radius, double speed) {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, 0, 0);
  set(simulation.mutable_container()->mutable_min(), -1.5, -1.5, -1.5);
  set(simulation.mutable_container()->mutable_max(), 1.5, 1.5, 1.5);
  v1::Emitter* emitter = simulation.add_fluids()->add_emitters();
  set(emitter->mutable_position(), -1.2, 0, 0);
  set(emitter->mutable_direction(), 1, 0, 0);
  emitter->set_radius(radius);
  emitter->set_speed(speed);
  return simulation;
}

v1::Emitter& emitterOf(v1::Simulation& settings) { return *settings.mutable_fluids(0)->mutable_emitters(0); }

void addDrain(v1::Simulation& settings, std::array<double, 3> low, std::array<double, 3> high) {
  v1::Box* box = settings.add_drains()->mutable_box();
  set(box->mutable_min(), low[0], low[1], low[2]);
  set(box->mutable_max(), high[0], high[1], high[2]);
}

/// A jet into a pool with a drain in its floor: everything that comes and goes.
v1::Simulation basin() {
  v1::Simulation settings = jet(0.11, 3);
  settings.mutable_gravity()->set_y(-9.81);
  set(settings.mutable_container()->mutable_min(), -0.6, 0, -0.4);
  set(settings.mutable_container()->mutable_max(), 0.6, 1.2, 0.4);
  set(emitterOf(settings).mutable_position(), 0, 1, 0);
  set(emitterOf(settings).mutable_direction(), 0.2, -1, 0);
  v1::Block* pool = settings.mutable_fluids(0)->add_blocks();
  set(pool->mutable_first_particle(), -0.55, kSpacing, -0.35);
  pool->set_count_x(23);
  pool->set_count_y(3);
  pool->set_count_z(15);
  addDrain(settings, {-0.6, 0, -0.4}, {-0.4, 0.12, 0.4});
  return settings;
}

void expectRefused(const v1::Simulation& settings, const std::string& fieldPath, const std::string& reason) {
  try {
    const FluidSimulation simulation(settings);
    FAIL() << "taken, though " << reason;
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), fieldPath);
    EXPECT_THAT(error.problem(), HasSubstr(reason));
  }
}

std::vector<std::uint32_t> sortedIds(const FluidSimulation& simulation) {
  std::vector<std::uint32_t> ids = simulation.state().id;
  std::ranges::sort(ids);
  return ids;
}

std::map<std::uint32_t, std::array<float, 6>> placesById(const ParticleState& state) {
  std::map<std::uint32_t, std::array<float, 6>> places;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Float4& x = state.position[i];
    const Float4& v = state.velocity[i];
    places[state.id[i]] = {x.x, x.y, x.z, v.x, v.y, v.z};
  }
  return places;
}

std::uint64_t starting(const v1::Simulation& settings) {
  v1::Simulation without = settings;
  without.mutable_fluids(0)->clear_emitters();
  return FluidSimulation(without).state().size();
}

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

TEST(Population, ParticlesAreNeitherLostNorMadeUp) {
  const v1::Simulation settings = basin();
  FluidSimulation simulation(settings, {.threads = 2});
  const std::uint64_t initial = starting(settings);
  std::map<std::uint32_t, double> seen;  // When each was first there.
  std::vector<std::uint32_t> former;     // One step ago.
  while (simulation.time() < 0.6) {
    ASSERT_TRUE(simulation.advance()) << simulation.halted();
    const std::vector<std::uint32_t> ids = sortedIds(simulation);
    ASSERT_EQ(std::ranges::adjacent_find(ids), ids.end());
    const PopulationState& population = simulation.population().state();
    ASSERT_EQ(ids.size(), initial + simulation.population().emitted() - population.drained);
    for (const std::uint32_t id : ids) {
      const bool isNew = seen.try_emplace(id, simulation.time()).second;
      ASSERT_TRUE(isNew || std::ranges::binary_search(former, id)) << "number " << id << " given again";
    }
    former = ids;
    const auto snapshot = simulation.snapshot();
    for (std::size_t i = 0; i < snapshot->size(); ++i) {
      const double since = snapshot->ids[i] < initial ? simulation.time() : simulation.time() - seen[snapshot->ids[i]];
      ASSERT_GE(snapshot->ages[i], since - 1e-6);
      ASSERT_LE(snapshot->ages[i], since + 0.01);
    }
  }
  EXPECT_GT(simulation.population().state().drained, 100U);
  EXPECT_GT(simulation.population().emitted(), 300U);
}

TEST(Drain, LeavesNoParticleInside) {
  v1::Simulation settings = basin();
  settings.mutable_fluids(0)->clear_emitters();
  FluidSimulation simulation(settings);
  while (simulation.time() < 0.5) {
    ASSERT_TRUE(simulation.advance());
    for (const Float4& x : simulation.state().position) ASSERT_FALSE(x.x < 0.2F && x.y < 0.12F);
  }
  EXPECT_LT(simulation.state().size(), 900U);
}

class EverySolverWithAFlow : public testing::TestWithParam<const char*> {
 protected:
  static v1::Simulation with(v1::Simulation settings) {
    const std::string name = GetParam();
    if (name == "iisph") settings.mutable_iisph();
    if (name == "pbf") settings.mutable_pbf();
    if (name == "wcsph") settings.mutable_wcsph()->mutable_density_diffusion();
    if (name == "everything_else") {
      settings.mutable_surface_tension()->set_tension(0.05);
      settings.mutable_micropolar();
      settings.mutable_implicit_viscosity();
      v1::Fluid* other = settings.add_fluids();
      other->set_rest_density(800);
      *other->add_emitters() = settings.fluids(0).emitters(0);
      other->mutable_emitters(0)->mutable_position()->set_x(-0.3);
      other->mutable_emitters(0)->set_start_seconds(0.05);
    }
    return settings;
  }
};

TEST_P(EverySolverWithAFlow, HasTheSameBitsForAnyNumberOfThreads) {
  const v1::Simulation settings = with(basin());
  const auto after = [&](int threads) {
    FluidSimulation simulation(settings, {.threads = threads});
    for (int step = 0; step < 80; ++step) EXPECT_TRUE(simulation.advance());
    EXPECT_GT(simulation.population().emitted(), 20U);
    return simulation.state();
  };
  const ParticleState one = after(1);
  EXPECT_TRUE(after(2) == one);
  EXPECT_TRUE(after(4) == one);
}

TEST_P(EverySolverWithAFlow, RunsFromNothingToNothing) {
  v1::Simulation settings = with(jet(0.06, 2));
  settings.mutable_gravity()->set_y(-9.81);
  for (v1::Fluid& fluid : *settings.mutable_fluids()) {
    fluid.mutable_emitters(0)->set_start_seconds(0.05);
    fluid.mutable_emitters(0)->set_end_seconds(0.3);
  }
  addDrain(settings, {-1.5, -1.5, -1.5}, {1.5, -1.3, 1.5});
  FluidSimulation simulation(settings);
  EXPECT_EQ(simulation.state().size(), 0U);
  std::size_t most = 0;
  while (simulation.time() < 1.5) {
    ASSERT_TRUE(simulation.advance()) << simulation.halted();
    most = std::max(most, simulation.state().size());
    ASSERT_TRUE(std::isfinite(simulation.statistics().meanDensityError));
  }
  EXPECT_GT(most, 40U);
  EXPECT_EQ(simulation.state().size(), 0U);
}

TEST_P(EverySolverWithAFlow, StartsAnewTheSame) {
  const v1::Simulation settings = with(basin());
  FluidSimulation simulation(settings);
  const ParticleState initial = simulation.state();
  for (int step = 0; step < 40; ++step) ASSERT_TRUE(simulation.advance());
  const ParticleState moved = simulation.state();
  simulation.reset();
  EXPECT_TRUE(simulation.state() == initial);
  for (int step = 0; step < 40; ++step) ASSERT_TRUE(simulation.advance());
  EXPECT_TRUE(simulation.state() == moved);
}

INSTANTIATE_TEST_SUITE_P(All, EverySolverWithAFlow,
                         testing::Values("dfsph", "iisph", "pbf", "wcsph", "everything_else"),
                         [](const auto& solver) { return std::string(solver.param); });

// The position-based solver notices what is wrong after particles have come and gone.
TEST(Population, IsAsBeforeAfterAStepThatWasTakenBack) {
  v1::Simulation settings = basin();
  settings.mutable_pbf();
  FluidSimulation simulation(settings);
  // Particles come and go in the very step.
  std::uint64_t given = 0;
  while (simulation.population().emitted() < 60 || simulation.population().state().drained < 10) {
    given = simulation.population().emitted();
    ASSERT_TRUE(simulation.advance());
  }
  ASSERT_GT(given, 0U);
  const ParticleState before = simulation.state();
  const PopulationState population = simulation.population().state();
  // A compression that no step can keep: the simulation halts, with the last good state.
  v1::Scene scene = sceneOf(settings);
  scene.mutable_simulation()->mutable_time_step()->set_max_compression(1e-9);
  scene.mutable_simulation()->mutable_time_step()->set_min_seconds(1e-4);
  simulation.update(scene);
  EXPECT_FALSE(simulation.advance());
  ASSERT_THAT(simulation.halted(), HasSubstr("max_compression"));
  EXPECT_TRUE(simulation.population().state() == population);
  EXPECT_EQ(placesById(simulation.state()), placesById(before));
  simulation.update(sceneOf(settings));
  EXPECT_TRUE(simulation.advance());
}

TEST(Population, PlanSaysThatThereAreNeitherEmittersNorDrains) {
  const core::Plan plan = FluidSimulation(smallDamBreak()).plan();
  EXPECT_THAT(plan.leftOut, Contains(core::LeftOut{"emitters", "none"}));
  EXPECT_THAT(plan.leftOut, Contains(core::LeftOut{"drains", "none"}));
  const auto names = [](const core::Plan& flowing) {
    std::vector<std::string> all;
    for (const core::PlannedStage& stage : flowing.stages) all.push_back(stage.name);
    return all;
  };
  EXPECT_THAT(names(FluidSimulation(basin()).plan()), testing::IsSupersetOf({"emitters", "drains"}));
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

TEST(Drain, OutsideTheContainerIsRefused) {
  v1::Simulation settings = jet(0.06, 1);
  addDrain(settings, {2, 0, 0}, {3, 1, 1});
  expectRefused(settings, "simulation.drains[0].box", "outside the container");
}

}  // namespace
}  // namespace sluice::sim
