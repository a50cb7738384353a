#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

// Symplectic Euler without any force but gravity: v_n = g Σ dt, x_n = x_0 + Σ v_n dt. Floats of about 4 m resolve
// 2⁻²² m; a hundred steps add up to a few times that.
TEST(Physics, FreeFallIsExactForTheScheme) {
  v1::Simulation settings = floatingCube(1);
  settings.mutable_gravity()->set_y(-9.81);
  FluidSimulation simulation(settings);
  const double start = simulation.state().position[0].y;
  double velocity = 0;
  double position = start;
  for (int step = 0; step < 100; ++step) {
    ASSERT_TRUE(simulation.advance());
    const double dt = simulation.statistics().timeStepSeconds;
    velocity -= 9.81 * dt;
    position += velocity * dt;
  }
  EXPECT_LT(position, start - 0.5);
  EXPECT_NEAR(simulation.state().velocity[0].y, velocity, 1e-5);
  EXPECT_NEAR(simulation.state().position[0].y, position, 1e-5);
}

TEST(Physics, ABlockFallsWithoutDeforming) {
  v1::Simulation settings = floatingCube(6);
  settings.mutable_gravity()->set_y(-9.81);
  FluidSimulation simulation(settings);
  const std::vector<Float4> before = positionsById(simulation);
  for (int step = 0; step < 50; ++step) ASSERT_TRUE(simulation.advance());
  const std::vector<Float4> after = positionsById(simulation);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i].x, before[i].x, 1e-5);
    EXPECT_NEAR(after[i].y - after[0].y, before[i].y - before[0].y, 1e-5);
    EXPECT_NEAR(after[i].z, before[i].z, 1e-5);
  }
}

struct Momentum {
  double x = 0, y = 0, z = 0;
  double spin = 0;  ///< Angular momentum about z.
};

Momentum momentumOf(const FluidSimulation& simulation) {
  Momentum total;
  const ParticleState& state = simulation.state();
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Float4& x = state.position[i];
    const Float4& v = state.velocity[i];
    total.x += v.x;
    total.y += v.y;
    total.z += v.z;
    total.spin += (x.x - 5.0) * v.y - (x.y - 5.0) * v.x;
  }
  return total;
}

// Two halves of a cube collide off-centre: pressure and viscosity act, walls and gravity do not.
TEST(Physics, MomentumIsKeptWithoutWallsAndGravity) {
  v1::Simulation settings = floatingCube(10);
  settings.mutable_fluids(0)->set_viscosity(0.01);
  v1::Block* left = settings.mutable_fluids(0)->mutable_blocks(0);
  v1::Block* right = settings.mutable_fluids(0)->add_blocks();
  *right = *left;
  left->mutable_first_particle()->set_x(-0.55);
  left->mutable_velocity()->set_x(2);
  right->mutable_first_particle()->set_x(0.05);
  right->mutable_first_particle()->set_y(right->first_particle().y() + 0.2);
  right->mutable_velocity()->set_x(-1);
  FluidSimulation simulation(settings);
  const Momentum before = momentumOf(simulation);
  const auto particles = static_cast<double>(simulation.state().size());
  runUntil(simulation, 0.3);
  const Momentum after = momentumOf(simulation);
  ASSERT_GT(simulation.statistics().steps, 50U);
  // Each of about a hundred steps rounds velocities of 2 m/s to 2⁻²³ of that; the roundings add up at random.
  const double tolerance = 1e-6 * particles;
  EXPECT_NEAR(after.x, before.x, tolerance);
  EXPECT_NEAR(after.y, before.y, tolerance);
  EXPECT_NEAR(after.z, before.z, tolerance);
  // The positions move between the forces and this sum, and the impulses are not quite central: small, not round-off.
  EXPECT_NEAR(after.spin, before.spin, 0.01 * std::abs(before.spin));
}

TEST(Physics, AColumnStaysAtRest) {
  constexpr std::uint32_t kLayers = 12;
  FluidSimulation simulation(column(8, kLayers));
  const double height = 0.05 * kLayers;
  const double unitSpeed = std::sqrt(9.81 * height);
  runUntil(simulation, 1.5);
  ASSERT_EQ(simulation.halted(), "");

  double highest = 0;
  double meanHeight = 0;
  for (const Float4& x : simulation.state().position) {
    highest = std::max(highest, static_cast<double>(x.y));
    meanHeight += x.y / static_cast<double>(simulation.state().size());
  }
  // The lattice's own figures are 0.05 · 12 and 0.05 · 6.5. Settling moves them by less than half a spacing: a loose
  // packing stands a little closer to the four walls than the lattice did.
  EXPECT_NEAR(highest, 0.05 * kLayers, 0.03);
  EXPECT_NEAR(meanHeight, 0.05 * (kLayers + 1) / 2, 0.025);
  EXPECT_LT(simulation.statistics().maxSpeed, 0.05 * unitSpeed);
  EXPECT_LT(simulation.statistics().meanDensityError, 0.002);
}

// κ of the density solve is p dt / ρ0: with p = ρ0 g h it grows linearly with depth.
TEST(Physics, PressureInAColumnGrowsWithDepth) {
  constexpr std::uint32_t kLayers = 12;
  v1::Simulation settings = column(8, kLayers);
  settings.mutable_dfsph()->set_density_error(0.005);
  FluidSimulation simulation(settings);
  runUntil(simulation, 1.0);
  double pressure[kLayers] = {};
  double count[kLayers] = {};
  // Over some steps, because single steps flicker about the mean.
  for (int step = 0; step < 50; ++step) {
    ASSERT_TRUE(simulation.advance());
    const ParticleState& state = simulation.state();
    for (std::size_t i = 0; i < state.size(); ++i) {
      // The particles next to the side walls carry more: a wall answers with κ_i only, not κ_i + κ_j.
      const Float4& x = state.position[i];
      const auto inside = [](float place) { return place > 0.12F && place < 9 * 0.05F - 0.12F; };
      if (!inside(x.x) || !inside(x.z)) continue;
      const int layer = std::clamp(static_cast<int>(state.position[i].y / 0.05F - 0.5F), 0, int{kLayers} - 1);
      pressure[layer] += state.densityImpulse[i] / simulation.statistics().timeStepSeconds;
      count[layer] += 1;
    }
  }
  const auto meanOf = [&](int layer) { return pressure[layer] / count[layer]; };
  const double gradient = (meanOf(2) - meanOf(8)) / (6 * 0.05);
  EXPECT_NEAR(gradient, 9.81, 0.15 * 9.81);
  EXPECT_GT(meanOf(2), meanOf(5));
  EXPECT_GT(meanOf(5), meanOf(8));
}

// p ≈ ρ0 g depth, of the snapshots: 15 % of the pressure at the floor. Half of that is the lattice's (the surface
// stands somewhere within a spacing, a twelfth of the depth), the rest the 5 % that single layers differ by.
TEST(Physics, SnapshotsTellTheHydrostaticPressure) {
  constexpr std::uint32_t kLayers = 12;
  constexpr double kDensity = 850;
  v1::Simulation settings = column(8, kLayers);
  settings.mutable_fluids(0)->set_rest_density(kDensity);
  settings.mutable_dfsph()->set_density_error(0.005);
  FluidSimulation simulation(settings);
  EXPECT_EQ(simulation.snapshot()->pressures, std::vector<float>(simulation.state().size(), 0.0F));
  runUntil(simulation, 1.0);
  double sum[kLayers] = {};
  double depth[kLayers] = {};
  double count[kLayers] = {};
  for (int step = 0; step < 50; ++step) {
    ASSERT_TRUE(simulation.advance());
    const auto snapshot = simulation.snapshot();
    double surface = 0;
    for (const Eigen::Vector3f& x : snapshot->positions) surface = std::max(surface, x.y() + 0.025);
    const Eigen::Vector3f low(static_cast<float>(settings.container().min().x()), 0,
                              static_cast<float>(settings.container().min().z()));
    for (std::size_t i = 0; i < snapshot->size(); ++i) {
      const Eigen::Vector3f x = snapshot->positions[i] - low;
      const auto inside = [](float place) { return place > 0.12F && place < 9 * 0.05F - 0.12F; };
      if (!inside(x.x()) || !inside(x.z())) continue;
      const double below = surface - snapshot->positions[i].y();
      const auto layer = static_cast<std::size_t>(std::clamp(below / 0.05, 0.0, kLayers - 1.0));
      sum[layer] += snapshot->pressures[i];
      depth[layer] += below;
      count[layer] += 1;
    }
  }
  const double atFloor = kDensity * 9.81 * 0.05 * kLayers;
  for (std::size_t layer = 2; layer < kLayers - 1; ++layer) {
    if (count[layer] < 50) continue;
    EXPECT_NEAR(sum[layer] / count[layer], kDensity * 9.81 * depth[layer] / count[layer], 0.15 * atFloor)
        << "layer " << layer;
  }
}

TEST(Physics, SnapshotsTellTheAge) {
  FluidSimulation simulation(floatingCube(3));
  runUntil(simulation, 0.1);
  const auto snapshot = simulation.snapshot();
  EXPECT_EQ(snapshot->ages, std::vector<float>(27, static_cast<float>(simulation.time())));
}

TEST(Physics, DamBreakKeepsItsParticlesAndLosesEnergy) {
  FluidSimulation simulation(smallDamBreak());
  const double spacing = 0.05;
  double energy = meanEnergy(simulation);
  const double start = energy;
  float front = 0;
  while (simulation.time() < 1.2) {
    ASSERT_TRUE(simulation.advance()) << simulation.halted();
    for (const Float4& x : simulation.state().position) {
      ASSERT_TRUE(x.x >= 0 && x.x <= 1.6F && x.y >= 0 && x.y <= 1.2F && x.z >= 0 && x.z <= 0.8F);
      front = std::max(front, x.x);
    }
    ASSERT_LT(meanEnergy(simulation), energy + 0.002 * start) << "at " << simulation.time() << " s";
    energy = std::min(energy, meanEnergy(simulation));
  }
  // It has run through the tank: 1.1 m in 1.2 s, at a front speed of up to 2 √(g h) = 6.3 m/s.
  EXPECT_GT(front, 1.6F - 2 * static_cast<float>(spacing));
  EXPECT_LT(energy, 0.8 * start);
  EXPECT_LT(simulation.statistics().meanDensityError, 0.002);
}

TEST(Physics, ViscosityBrakesShear) {
  double shear[2];
  for (const int viscous : {0, 1}) {
    v1::Simulation settings = floatingCube(10);
    settings.mutable_fluids(0)->set_viscosity(viscous * 0.05);
    v1::Block* lower = settings.mutable_fluids(0)->mutable_blocks(0);
    v1::Block* upper = settings.mutable_fluids(0)->add_blocks();
    *upper = *lower;
    lower->set_count_y(5);
    upper->set_count_y(5);
    upper->mutable_first_particle()->set_y(lower->first_particle().y() + 5 * 0.05);
    upper->mutable_velocity()->set_x(0.2);
    FluidSimulation simulation(settings);
    runUntil(simulation, 0.1);
    double sum = 0;
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      sum += (simulation.state().id[i] < 500 ? -1 : 1) * simulation.state().velocity[i].x / 500;
    }
    shear[viscous] = sum;
  }
  EXPECT_NEAR(shear[0], 0.2, 0.01);
  EXPECT_LT(shear[1], 0.8 * shear[0]);
  EXPECT_GT(shear[1], 0);
}

}  // namespace
}  // namespace sluice::sim
