// Fluid that meets bodies: it does not pass, it rests, and its pressure grows with depth.

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

using Eigen::Vector3d;

class EverySolverAtBodies : public testing::TestWithParam<const char*> {
 protected:
  static v1::Simulation tank() {
    v1::Simulation settings = emptyTank();
    const std::string name = GetParam();
    if (name == "iisph") settings.mutable_iisph();
    if (name == "pbf") settings.mutable_pbf();
    if (name == "wcsph") settings.mutable_wcsph();
    return settings;
  }
};

// Loose particles among them, which no pressure stops: the plate is thinner than a fast particle's step.
TEST_P(EverySolverAtBodies, AJetDoesNotGoThroughAPlate) {
  v1::Simulation settings = tank();
  settings.mutable_gravity()->set_y(0);
  settings.mutable_time_step()->set_cfl(1);
  addBlock(settings, {-0.5, -0.1, -0.1}, 5, 5, 5, {8, 0, 0});
  addBlock(settings, {-0.8, 0.4, 0.4}, 1, 1, 1, {8, 0, 0});
  FluidSimulation simulation(settings, listOf({box({0.1, 0, 0}, {0.06, 1.999, 1.999})}));
  runUntil(simulation, 0.25);
  EXPECT_EQ(simulation.halted(), "");
  // With integrated densities even a lone particle is stopped by pressure.
  EXPECT_TRUE(simulation.wallContacts() > 0 || settings.has_wcsph());
  forEachParticle(simulation, [](const Vector3d& x) { EXPECT_LT(x.x(), 0.07); });
}

TEST_P(EverySolverAtBodies, AColumnFallsAroundASphere) {
  v1::Simulation settings = tank();
  addBlock(settings, {-0.1, -0.4, -0.1}, 5, 8, 5, {0, -4, 0});
  FluidSimulation simulation(settings, listOf({sphere({0.01, -0.7, 0.02}, 0.2)}));
  runUntil(simulation, 0.25);
  EXPECT_EQ(simulation.halted(), "");
  forEachParticle(simulation,
                  [](const Vector3d& x) { EXPECT_GT((x - Vector3d(0.01, -0.7, 0.02)).norm(), 0.2 + 0.4 * kSpacing); });
}

INSTANTIATE_TEST_SUITE_P(All, EverySolverAtBodies, testing::Values("dfsph", "iisph", "pbf", "wcsph"),
                         [](const auto& solver) { return std::string(solver.param); });

/// Water that a square column of it leaves in a vessel 0.5 m wide: nobody is outside, the surface is level.
void expectRest(const v1::Body& vessel, int across) {
  v1::Simulation settings = emptyTank();
  const double half = 0.5 * kSpacing * (across - 1);
  addBlock(settings, {-half, -0.35, -half}, across, 10, across, {0, 0, 0});
  FluidSimulation simulation(settings, listOf({vessel}));
  EXPECT_EQ(simulation.state().size(), static_cast<std::size_t>(across * across * 10));
  runUntil(simulation, 2);
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_LT(simulation.statistics().meanDensityError, 2e-3);
  EXPECT_LT(simulation.statistics().maxDensityError, 0.1);
  // The highest particle over each of four quarters.
  std::array<double, 4> top{-1, -1, -1, -1};
  forEachParticle(simulation, [&](const Vector3d& x) {
    EXPECT_LT(std::abs(x.x()), 0.25);
    EXPECT_LT(std::abs(x.z()), 0.25);
    EXPECT_GT(x.y(), -0.4);
    double& highest = top[(x.x() > 0 ? 1U : 0U) + (x.z() > 0 ? 2U : 0U)];
    highest = std::max(highest, x.y());
  });
  const auto [low, high] = std::minmax_element(top.begin(), top.end());
  EXPECT_LT(*high - *low, kSpacing);
  EXPECT_LT(*high, 0.2);
  EXPECT_GT(*low, -0.15);
}

TEST(Bodies, WaterRestsInAnOpenBox) { expectRest(box({0, -0.1, 0}, {0.5, 0.6, 0.5}, true), 9); }
TEST(Bodies, WaterRestsInAnOpenCylinder) { expectRest(cylinder({0, -0.1, 0}, 0.25, 0.6, true), 7); }

/// 15 %, as of a column in a box: see Physics.PressureInAColumnGrowsWithDepth.
constexpr double kPressureTolerance = 0.15;

TEST(Bodies, PressureGrowsWithDepthInAnOpenCylinder) {
  v1::Simulation settings = emptyTank();
  settings.mutable_dfsph()->set_density_error(0.005);
  addBlock(settings, {-0.25, -0.35, -0.25}, 11, 14, 11, {0, 0, 0});
  FluidSimulation simulation(settings, listOf({cylinder({0, 0.1, 0}, 0.4, 1, true)}));
  runUntil(simulation, 2);
  const double gradient = pressureGradient(simulation, [](const Vector3d& x) {
    return std::hypot(x.x(), x.z()) < 0.4 - 2.5 * kSpacing && x.y() > -0.4 + 2.5 * kSpacing && x.y() < 0;
  });
  EXPECT_NEAR(gradient, 1, kPressureTolerance);
}

TEST(Bodies, PressureGrowsWithDepthAroundACylinder) {
  v1::Simulation settings = emptyTank();
  settings.mutable_dfsph()->set_density_error(0.005);
  set(settings.mutable_container()->mutable_min(), -0.6, -1, -0.6);
  set(settings.mutable_container()->mutable_max(), 0.6, 1, 0.6);
  addBlock(settings, {-0.55, -0.95, -0.55}, 23, 14, 23, {0, 0, 0});
  FluidSimulation simulation(settings, listOf({cylinder({0, -0.5, 0}, 0.25, 1)}));
  runUntil(simulation, 2);
  const double gradient = pressureGradient(simulation, [](const Vector3d& x) {
    return std::hypot(x.x(), x.z()) > 0.25 + 2.5 * kSpacing && std::abs(x.x()) < 0.6 - 2.5 * kSpacing &&
           std::abs(x.z()) < 0.6 - 2.5 * kSpacing && x.y() > -1 + 2.5 * kSpacing && x.y() < -0.4;
  });
  EXPECT_NEAR(gradient, 1, kPressureTolerance);
}

}  // namespace
}  // namespace sluice::sim
