// Adhesion of the fluids to walls, standing bodies and floating ones.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Core>

#include "scenes.h"

namespace sluice::sim {
namespace {

using Eigen::Vector3d;
using testing::Contains;

constexpr double kParticleMass = 1000 * kSpacing * kSpacing * kSpacing;

Vector3d vector(const Float4& v) { return {v.x, v.y, v.z}; }

/// A block of fluid without gravity and viscosity above the floor of an otherwise distant container, whose wall's
/// particles do not line up with the fluid's.
v1::Simulation blockAbove(double height, std::uint32_t across, std::uint32_t layers) {
  v1::Simulation settings = floatingCube(1);
  set(settings.mutable_container()->mutable_min(), {0, 0, 0});
  set(settings.mutable_container()->mutable_max(), kSpacing * Vector3d(30.5, 30.5, 30.5));
  v1::Block& block = *settings.mutable_fluids(0)->mutable_blocks(0);
  set(block.mutable_first_particle(), {5 * kSpacing, height, 5 * kSpacing});
  block.set_count_x(across);
  block.set_count_y(layers);
  block.set_count_z(across);
  return settings;
}

Vector3d momentumOf(const FluidSimulation& simulation) {
  Vector3d sum = Vector3d::Zero();
  for (const Float4& v : simulation.state().velocity) sum += kParticleMass * vector(v);
  return sum;
}

double meanHeight(const FluidSimulation& simulation) {
  double sum = 0;
  for (const Float4& x : simulation.state().position) sum += x.y;
  return sum / static_cast<double>(simulation.state().size());
}

TEST(Adhesion, PullsTowardsTheWallWithinItsReachAlone) {
  for (const bool near : {true, false}) {
    v1::Simulation settings = blockAbove((near ? 1.5 : 2.1) * kSpacing, 1, 1);
    settings.set_wall_adhesion(1);
    FluidSimulation simulation(settings);
    ASSERT_TRUE(simulation.advance());
    if (near) {
      EXPECT_LT(simulation.state().velocity[0].y, -1e-4);
    } else {
      EXPECT_EQ(simulation.state().velocity[0].y, 0);
    }
  }
}

// 10 %: the layer is lifted through places that are a tenth of a spacing apart, over a wall lattice that is a little
// finer than the fluid's.
TEST(Adhesion, TakesTwiceItsValueOfWorkPerArea) {
  constexpr double kAdhesion = 3;
  constexpr int kAcross = 20;
  constexpr int kPlaces = 10;
  double work = 0;
  for (int k = 0; k < kPlaces; ++k) {
    v1::Simulation settings = blockAbove((1 + (k + 0.5) / kPlaces) * kSpacing, kAcross, 1);
    settings.set_wall_adhesion(kAdhesion);
    FluidSimulation simulation(settings);
    ASSERT_TRUE(simulation.advance());
    const double force = -momentumOf(simulation).y() / simulation.statistics().timeStepSeconds;
    work += force * kSpacing / kPlaces;
  }
  EXPECT_NEAR(work / (kAcross * kAcross * kSpacing * kSpacing), 2 * kAdhesion, 0.2 * kAdhesion);
}

TEST(Adhesion, HoldsADropUnderACeiling) {
  for (const double adhesion : {0.0, 100.0}) {
    v1::Simulation settings = blockAbove(kSpacing * (30.5 - 4), 8, 4);
    settings.mutable_gravity()->set_y(-2);
    settings.mutable_fluids(0)->set_viscosity(0.05);
    settings.mutable_surface_tension()->set_tension(100);
    settings.set_wall_adhesion(adhesion);
    FluidSimulation simulation(settings);
    const double before = meanHeight(simulation);
    runUntil(simulation, 0.6);
    ASSERT_EQ(simulation.halted(), "");
    if (adhesion > 0) {
      EXPECT_NEAR(meanHeight(simulation), before, 1.5 * kSpacing);
    } else {
      EXPECT_LT(meanHeight(simulation), before - 5 * kSpacing) << "it falls 0.36 m";
    }
  }
}

/// A cube of water beside a box that floats, off its middle, without gravity.
std::unique_ptr<FluidSimulation> besideABox(double adhesion, const SimulationOptions& options = {}) {
  v1::Simulation settings = floatingCube(6);
  v1::Body body = box({0.35, 0.05, 0}, {0.3, 0.3, 0.3});
  body.mutable_floating()->set_density(300);
  body.set_adhesion(adhesion);
  return std::make_unique<FluidSimulation>(settings, listOf({body}), options);
}

TEST(Adhesion, AFloatingBodyIsPulledAsMuchAsItPulls) {
  const auto simulation = besideABox(50);
  for (int step = 0; step < 60; ++step) ASSERT_TRUE(simulation->advance()) << simulation->halted();
  const double mass = 300 * 0.027;
  const Vector3d ofFluid = momentumOf(*simulation);
  const Vector3d ofBox = mass * simulation->movingBodies().twist(0).head<3>();
  double largest = 0;
  for (const Float4& v : simulation->state().velocity) largest = std::max(largest, vector(v).norm());
  EXPECT_GT(largest, 0.01);
  EXPECT_LT((ofFluid + ofBox).norm(), 1e-4 * largest * mass);
}

TEST(Adhesion, AFloatingBodyComesToTheFluid) {
  const auto simulation = besideABox(50);
  for (int step = 0; step < 3; ++step) ASSERT_TRUE(simulation->advance()) << simulation->halted();
  EXPECT_GT(momentumOf(*simulation).x(), 0);
  EXPECT_LT(simulation->movingBodies().twist(0)[0], 0);
}

TEST(Adhesion, AStandingBodyHasItsOwn) {
  for (const double adhesion : {0.0, 20.0}) {
    v1::Simulation settings = floatingCube(1);
    v1::Body body = box({0, -0.2 - 0.075, 0}, {0.4, 0.4, 0.4});
    body.set_adhesion(adhesion);
    FluidSimulation simulation(settings, listOf({body}));
    ASSERT_TRUE(simulation.advance());
    if (adhesion > 0) {
      EXPECT_LT(simulation.state().velocity[0].y, -1e-4);
    } else {
      EXPECT_EQ(simulation.state().velocity[0].y, 0);
    }
  }
}

TEST(Adhesion, IsPlannedWhereThereIsSomeAlone) {
  v1::Simulation settings = smallDamBreak();
  StepTraits traits{.particles = 100, .boundaryInReach = true};
  EXPECT_THAT(planStep(settings, traits).leftOut, Contains(core::LeftOut{"adhesion", "no wall or body has any"}));
  traits.standingAdhere = true;
  EXPECT_TRUE(planStep(settings, traits).contains(Stage::Adhesion));
  traits.boundaryInReach = false;
  EXPECT_THAT(planStep(settings, traits).leftOut,
              Contains(core::LeftOut{"adhesion", "no particle is near what has it"}));
  traits.movingAdhere = traits.bodiesInReach = true;
  EXPECT_TRUE(planStep(settings, traits).contains(Stage::Adhesion));
  settings.set_wall_adhesion(1);
  EXPECT_TRUE(planStep(settings, {.particles = 100}).contains(Stage::Adhesion));
}

TEST(Adhesion, WithoutStrengthOrFarFromWallsIsLeftOutAndWouldChangeNothing) {
  for (const bool far : {true, false}) {
    v1::Simulation settings = far ? floatingCube(8) : smallDamBreak();
    if (far) {
      settings.mutable_gravity()->set_y(-9.81);
      settings.set_wall_adhesion(10);
    }
    FluidSimulation lean(settings, {.threads = 1});
    FluidSimulation full(settings, {.threads = 1, .keepInertStages = true});
    for (int step = 0; step < 10; ++step) {
      ASSERT_TRUE(lean.advance());
      ASSERT_TRUE(full.advance());
    }
    const auto ran = [](const FluidSimulation& simulation) {
      const auto stages = simulation.statistics().stages;
      return std::ranges::count(stages, "adhesion", &core::StageTime::name) > 0;
    };
    EXPECT_FALSE(ran(lean));
    EXPECT_TRUE(ran(full));
    EXPECT_TRUE(lean.state() == full.state());
  }
}

TEST(Adhesion, HasTheSameBitsForAnyNumberOfThreads) {
  const auto after = [](int threads) {
    v1::Simulation settings = smallDamBreak();
    settings.set_wall_adhesion(5);
    v1::Body body = box({0.8, 0.15, 0.4}, {0.2, 0.2, 0.2});
    body.mutable_floating()->set_density(400);
    body.set_adhesion(20);
    FluidSimulation simulation(settings, listOf({body}), {.threads = threads});
    for (int step = 0; step < 60; ++step) EXPECT_TRUE(simulation.advance());
    return std::make_pair(simulation.state(), simulation.movingBodies().twist(0));
  };
  const auto one = after(1);
  for (const int threads : {2, 4}) {
    const auto several = after(threads);
    EXPECT_TRUE(several.first == one.first) << threads << " threads";
    EXPECT_EQ(several.second, one.second) << threads << " threads";
  }
}

TEST(Adhesion, BoundsTheStepAndChangesLive) {
  v1::Simulation settings = blockAbove(kSpacing, 4, 4);
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(simulation.statistics().timeStepLimit, "max_seconds");
  settings.set_wall_adhesion(2000);
  simulation.update(sceneOf(settings));
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(simulation.statistics().timeStepLimit, "adhesion");
}

}  // namespace
}  // namespace sluice::sim
