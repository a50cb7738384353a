// Particles that come and go: none is lost, none is given twice, and every solver takes it.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

using testing::Contains;
using testing::HasSubstr;

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

TEST(Drain, OutsideTheContainerIsRefused) {
  v1::Simulation settings = jet(0.06, 1);
  addDrain(settings, {2, 0, 0}, {3, 1, 1});
  expectRefused(settings, "simulation.drains[0].box", "outside the container");
}

}  // namespace
}  // namespace sluice::sim
