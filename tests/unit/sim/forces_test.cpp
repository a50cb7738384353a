// Surface tension and micropolar fluids.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Core>

#include "scenes.h"

namespace sluice::sim {
namespace {

Eigen::Vector3d vector(const Float4& v) { return {v.x, v.y, v.z}; }

Eigen::Vector3d momentumOf(const FluidSimulation& simulation) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Float4& v : simulation.state().velocity) sum += vector(v);
  return sum;
}

/// A viscous cube under tension.
v1::Simulation cubeUnderTension(bool he) {
  v1::Simulation settings = floatingCube(10);
  settings.mutable_fluids(0)->set_viscosity(0.05);
  v1::SurfaceTension* tension = settings.mutable_surface_tension();
  tension->set_tension(40);
  if (he) tension->mutable_he2014();
  return settings;
}

/// Largest distance from the middle over the mean one: 1.80 for a cube, 1.33 for a ball, but for half a spacing.
double cornerDistance(const FluidSimulation& simulation) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Float4& x : simulation.state().position) middle += vector(x);
  middle /= static_cast<double>(simulation.state().size());
  double largest = 0;
  double mean = 0;
  for (const Float4& x : simulation.state().position) {
    const double distance = (vector(x) - middle).norm();
    largest = std::max(largest, distance);
    mean += distance / static_cast<double>(simulation.state().size());
  }
  return largest / mean;
}

class Tension : public testing::TestWithParam<bool> {};

TEST_P(Tension, RoundsACubeAndKeepsItsMomentum) {
  FluidSimulation simulation(cubeUnderTension(GetParam()));
  const double before = cornerDistance(simulation);
  runUntil(simulation, 1.0);
  ASSERT_EQ(simulation.halted(), "");
  const double after = cornerDistance(simulation);
  EXPECT_GT(before, 1.6);
  EXPECT_LT(after, 1.42);
  EXPECT_GT(after, 1.2);
  EXPECT_LT(momentumOf(simulation).norm(), 1e-6 * 1000);
}

TEST_P(Tension, WithoutStrengthIsLeftOutAndWouldChangeNothing) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_surface_tension()->set_tension(0);
  if (GetParam()) settings.mutable_surface_tension()->mutable_he2014();
  FluidSimulation lean(settings, {.threads = 1});
  FluidSimulation full(settings, {.threads = 1, .keepInertStages = true});
  settings.clear_surface_tension();
  FluidSimulation without(settings, {.threads = 1});
  for (int step = 0; step < 10; ++step) {
    ASSERT_TRUE(lean.advance());
    ASSERT_TRUE(full.advance());
    ASSERT_TRUE(without.advance());
  }
  EXPECT_THAT(lean.plan().leftOut, testing::Contains(core::LeftOut{"surface tension", "the tension is 0"}));
  EXPECT_TRUE(lean.state() == full.state());
  EXPECT_TRUE(lean.state() == without.state());
}

INSTANTIATE_TEST_SUITE_P(SurfaceTension, Tension, testing::Bool(),
                         [](const auto& method) { return method.param ? "He2014" : "Akinci2013"; });

TEST(SurfaceTension, ActsWithinFluidsOnly) {
  // Two fluids side by side: cohesion holds each together, none the two.
  v1::Simulation settings = floatingCube(4);
  settings.mutable_surface_tension()->set_tension(1);
  settings.mutable_surface_tension()->mutable_akinci2013()->set_curvature(0);
  v1::Block beside = settings.fluids(0).blocks(0);
  beside.set_count_x(1);
  beside.set_count_y(1);
  beside.set_count_z(1);
  settings.mutable_fluids(0)->mutable_blocks(0)->CopyFrom(beside);
  beside.mutable_first_particle()->set_x(beside.first_particle().x() + 0.06);
  v1::Simulation two = settings;
  *settings.mutable_fluids(0)->add_blocks() = beside;
  addFluid(two, 1000, 0, beside);
  FluidSimulation one(settings);
  FluidSimulation apart(two);
  ASSERT_TRUE(one.advance());
  ASSERT_TRUE(apart.advance());
  EXPECT_GT(std::abs(one.state().velocity[0].x), 1e-5);
  EXPECT_EQ(one.state().velocity[0].x, -one.state().velocity[1].x);
  EXPECT_EQ(apart.state().velocity[0].x, 0);
}

TEST(SurfaceTension, BoundsTheStep) {
  v1::Simulation settings = floatingCube(4);
  settings.mutable_surface_tension()->set_tension(2000);
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  EXPECT_EQ(simulation.statistics().timeStepLimit, "surface tension");
}

/// A cube that turns about its axis along z as a rigid body would.
v1::Simulation fluidInASpin() {
  v1::Simulation settings = floatingCube(8);
  const v1::Block whole = settings.fluids(0).blocks(0);
  settings.mutable_fluids(0)->clear_blocks();
  for (std::uint32_t x = 0; x < 8; ++x) {
    for (std::uint32_t y = 0; y < 8; ++y) {
      v1::Block row = whole;
      row.set_count_x(1);
      row.set_count_y(1);
      row.mutable_first_particle()->set_x(whole.first_particle().x() + 0.05 * x);
      row.mutable_first_particle()->set_y(whole.first_particle().y() + 0.05 * y);
      row.mutable_velocity()->set_x(-0.5 * row.first_particle().y());
      row.mutable_velocity()->set_y(0.5 * row.first_particle().x());
      *settings.mutable_fluids(0)->add_blocks() = row;
    }
  }
  return settings;
}

TEST(Micropolar, SpinFollowsTheVorticityAndKeepsMomentum) {
  v1::Simulation settings = fluidInASpin();
  settings.mutable_micropolar()->set_inverse_inertia(200);
  FluidSimulation simulation(settings);
  ASSERT_TRUE(simulation.advance());
  // ω' = Θ⁻¹ ν_t ∇×v dt, ∇×v = 2 · 0.5/s; in the middle, where no neighbour is missing.
  const double expected = 200 * 0.01 * simulation.statistics().timeStepSeconds;
  int inside = 0;
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    const Float4& w = simulation.state().spin[i];
    if (simulation.neighbours().neighbours()[i] < 26) continue;
    ++inside;
    ASSERT_NEAR(w.x, 0, 1e-4 * expected);
    ASSERT_NEAR(w.z, expected, 0.03 * expected);
  }
  EXPECT_GT(inside, 100);
  runUntil(simulation, 0.3);
  ASSERT_EQ(simulation.halted(), "");
  EXPECT_LT(momentumOf(simulation).norm(), 1e-6 * 512);
}

TEST(Micropolar, OffHasNoBufferAndNoEffect) {
  v1::Simulation settings = smallDamBreak();
  FluidSimulation without(settings, {.threads = 1});
  settings.mutable_micropolar()->set_transfer(0);
  FluidSimulation lean(settings, {.threads = 1});
  FluidSimulation full(settings, {.threads = 1, .keepInertStages = true});
  for (int step = 0; step < 10; ++step) {
    ASSERT_TRUE(without.advance());
    ASSERT_TRUE(lean.advance());
    ASSERT_TRUE(full.advance());
  }
  EXPECT_TRUE(without.state().spin.empty());
  EXPECT_TRUE(lean.state() == full.state());
  EXPECT_EQ(positionsById(lean), positionsById(without));
}

}  // namespace
}  // namespace sluice::sim
