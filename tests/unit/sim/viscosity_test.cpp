#include <cmath>

#include <gtest/gtest.h>

#include "lattice.h"
#include "scenes.h"

namespace sluice::sim {
namespace {

/// A cube whose upper half slides over the lower one.
v1::Simulation shearedCube(double viscosity) {
  v1::Simulation settings = floatingCube(8);
  settings.mutable_fluids(0)->set_viscosity(viscosity);
  v1::Block* lower = settings.mutable_fluids(0)->mutable_blocks(0);
  lower->set_count_y(4);
  v1::Block upper = *lower;
  upper.mutable_first_particle()->set_y(lower->first_particle().y() + 4 * 0.05);
  upper.mutable_velocity()->set_x(0.2);
  *settings.mutable_fluids(0)->add_blocks() = upper;
  return settings;
}

std::vector<Float4> velocitiesById(const FluidSimulation& simulation) {
  std::vector<Float4> velocities(simulation.state().size());
  for (std::size_t i = 0; i < velocities.size(); ++i)
    velocities[simulation.state().id[i]] = simulation.state().velocity[i];
  return velocities;
}

/// ν of the explicit bound, for the test scenes' steps of 5 ms: the bound is on what the sums over pairs are scaled to.
const double kExplicitLimit = 0.1 * 0.05 * 0.05 / 0.005 * viscosityDeficit(KernelKind::CubicSpline, 0.05, 0.1);

TEST(ImplicitViscosity, EqualsTheExplicitOneForSmallViscosities) {
  v1::Simulation settings = shearedCube(0.02 * kExplicitLimit);
  settings.mutable_explicit_viscosity();
  FluidSimulation explicitOne(settings);
  settings.mutable_implicit_viscosity()->set_residual(1e-6);
  FluidSimulation implicitOne(settings);
  const std::vector<Float4> start = velocitiesById(explicitOne);
  for (int step = 0; step < 4; ++step) {
    ASSERT_TRUE(explicitOne.advance());
    ASSERT_TRUE(implicitOne.advance());
  }
  EXPECT_EQ(explicitOne.statistics().viscosityIterations, 0U);
  EXPECT_GT(implicitOne.statistics().viscosityIterations, 0U);
  const std::vector<Float4> a = velocitiesById(explicitOne);
  const std::vector<Float4> b = velocitiesById(implicitOne);
  double change = 0;
  double difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    change = std::max(change, static_cast<double>(std::abs(a[i].x - start[i].x)));
    difference = std::max(difference, static_cast<double>(std::abs(a[i].x - b[i].x)));
  }
  EXPECT_GT(change, 1e-4);
  // To first order in ν dt/h², which is 0.002 here, times the ten of the operator.
  EXPECT_LT(difference, 0.05 * change);
}

TEST(ImplicitViscosity, IsStableFarBeyondTheExplicitLimit) {
  FluidSimulation simulation(shearedCube(100 * kExplicitLimit));
  double energy = 1;
  for (int step = 0; step < 20; ++step) {
    ASSERT_TRUE(simulation.advance()) << simulation.halted();
    EXPECT_DOUBLE_EQ(simulation.statistics().timeStepSeconds, 0.005);
    EXPECT_GT(simulation.statistics().viscosityIterations, 0U);
    double next = 0;
    for (const Float4& v : simulation.state().velocity) next += v.x * v.x + v.y * v.y + v.z * v.z;
    ASSERT_LE(next, energy * 512);
    energy = next / 512;
  }
  // A block as stiff as that moves as one, with the mean velocity and a spin: the halves have lost their shear.
  double mean = 0;
  for (const Float4& v : simulation.state().velocity) mean += v.x / 512;
  EXPECT_NEAR(mean, 0.1, 1e-5);
}

TEST(ImplicitViscosity, KeepsMomentumOfUnequalFluids) {
  v1::Simulation settings = collidingFluids(10);
  settings.mutable_fluids(0)->set_viscosity(5);
  settings.mutable_fluids(1)->set_viscosity(1);
  FluidSimulation simulation(settings);
  const auto momentum = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      sum += (simulation.state().fluid[i] == 0 ? 10.0 : 1.0) * simulation.state().velocity[i].x;
    }
    return sum;
  };
  const double before = momentum();
  runUntil(simulation, 0.1);
  ASSERT_EQ(simulation.halted(), "");
  EXPECT_GT(simulation.statistics().viscosityIterations, 0U);
  EXPECT_NEAR(momentum(), before, 2e-6 * 11 * 1000);
}

// A step or two longer, and a column as viscous as that bursts at 0.25 s.
TEST(ExplicitViscosity, IsStableAtItsBound) {
  v1::Simulation settings = column(6, 12);
  settings.mutable_container()->mutable_max()->set_x(0.9);
  settings.mutable_fluids(0)->set_viscosity(1);
  settings.mutable_explicit_viscosity();
  FluidSimulation simulation(settings);
  while (simulation.time() < 0.4) {
    ASSERT_TRUE(simulation.advance()) << simulation.halted();
    ASSERT_EQ(simulation.statistics().timeStepLimit, "viscosity");
    ASSERT_LT(simulation.statistics().maxSpeed, 1);
  }
}

// Against sums written anew, of shear along x that varies along y: a quarter of the viscosity was missing.
TEST(ViscosityDeficit, IsThatOfALatticeWhoseRowsSlide) {
  EXPECT_NEAR(viscosityDeficit(KernelKind::CubicSpline, 1, 2, 2), 0.7330, 1e-3);
  EXPECT_NEAR(viscosityDeficit(KernelKind::CubicSpline, 1, 2, 3), 0.7917, 1e-3);
  EXPECT_NEAR(viscosityDeficit(KernelKind::WendlandC2, 1, 4, 3), 0.9495, 1e-3);
  // A ratio: units do not matter.
  EXPECT_NEAR(viscosityDeficit(KernelKind::CubicSpline, 0.01, 0.02, 2), 0.7330, 1e-3);
}

TEST(ImplicitViscosity, IsChosenOnlyWhereTheExplicitOneWouldShortenTheStep) {
  for (const double share : {0.9, 1.1}) {
    FluidSimulation simulation(shearedCube(share * kExplicitLimit));
    const bool isPlanned =
        planStep(shearedCube(share * kExplicitLimit), {.particles = 1, .implicitViscosity = share > 1})
            .contains(Stage::ImplicitViscosity);
    ASSERT_TRUE(simulation.advance());
    EXPECT_EQ(simulation.statistics().timeStepLimit, "max_seconds");
    EXPECT_EQ(simulation.statistics().viscosityIterations > 0, share > 1);
    EXPECT_EQ(isPlanned, share > 1);
  }
}

TEST(ImplicitViscosity, ReportsWhatItCannotSolve) {
  v1::Simulation settings = shearedCube(100);
  settings.mutable_implicit_viscosity()->set_max_iterations(1);
  settings.mutable_time_step()->set_min_seconds(0.002);
  FluidSimulation simulation(settings);
  const ParticleState before = simulation.state();
  EXPECT_FALSE(simulation.advance());
  EXPECT_NE(simulation.halted().find("the viscosity solve left a residual"), std::string::npos) << simulation.halted();
  EXPECT_TRUE(simulation.state() == before);
}

TEST(ImplicitViscosity, SameBitsForAnyNumberOfThreads) {
  const auto after = [](int threads) {
    v1::Simulation settings = smallDamBreak();
    settings.mutable_fluids(0)->set_viscosity(5);
    FluidSimulation simulation(settings, {.threads = threads});
    for (int step = 0; step < 10; ++step) EXPECT_TRUE(simulation.advance());
    EXPECT_GT(simulation.statistics().viscosityIterations, 0U);
    return simulation.state();
  };
  const ParticleState one = after(1);
  for (const int threads : {2, 4}) EXPECT_TRUE(after(threads) == one) << threads << " threads";
}

}  // namespace
}  // namespace sluice::sim
