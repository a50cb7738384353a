// Scenes of two dimensions.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

/// A column of one layer of particles, at rest.
v1::Simulation planarColumn(std::uint32_t width, std::uint32_t layers) {
  v1::Simulation simulation = column(width, layers);
  simulation.set_planar(true);
  simulation.mutable_container()->mutable_max()->set_z(0.2);
  v1::Block* block = simulation.mutable_fluids(0)->mutable_blocks(0);
  block->set_count_z(1);
  block->mutable_first_particle()->set_z(0.1);
  return simulation;
}

TEST(Planar, ALatticeBetweenItsWallsHasRestDensity) {
  for (const bool wendland : {false, true}) {
    v1::Simulation settings = planarColumn(12, 12);
    if (wendland) settings.mutable_wendland_c2()->set_support_in_spacings(2);
    const FluidSimulation simulation(settings);
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      const Float4& x = simulation.state().position[i];
      if (x.y > 0.575F) continue;  // The free surface.
      const bool inCorner = x.y < 0.075F && (x.x < 0.075F || x.x > 0.575F);
      EXPECT_NEAR(simulation.neighbours().density()[i], 1, inCorner ? 0.12 : 0.01);
    }
  }
}

TEST(Planar, WallsStandInThePlaneOnly) {
  const FluidSimulation simulation(planarColumn(9, 9));
  // 10 × 18 intervals around.
  EXPECT_EQ(simulation.boundary().size(), 2U * (10 + 18));
  for (const Float4& p : simulation.boundary().points()) EXPECT_FLOAT_EQ(p.z, 0.1F);
}

TEST(Planar, AColumnStaysAtRestInItsPlane) {
  for (const char* solver : {"dfsph", "iisph", "pbf", "wcsph"}) {
    v1::Simulation settings = planarColumn(16, 12);
    settings.mutable_fluids(0)->set_viscosity(0.05);
    if (solver == std::string("iisph")) settings.mutable_iisph();
    if (solver == std::string("pbf")) settings.mutable_pbf();
    if (solver == std::string("wcsph")) settings.mutable_wcsph()->mutable_density_diffusion();
    FluidSimulation simulation(settings);
    runUntil(simulation, 0.8);
    ASSERT_EQ(simulation.halted(), "") << solver;
    EXPECT_LT(simulation.statistics().meanDensityError, 0.01) << solver;
    EXPECT_LT(simulation.statistics().maxSpeed, 0.1 * std::sqrt(9.81 * 0.6)) << solver;
    double highest = 0;
    for (std::size_t i = 0; i < simulation.state().size(); ++i) {
      const Float4& x = simulation.state().position[i];
      ASSERT_EQ(x.z, 0.1F) << solver;
      ASSERT_EQ(simulation.state().velocity[i].z, 0) << solver;
      highest = std::max(highest, static_cast<double>(x.y));
    }
    EXPECT_NEAR(highest, 0.6, 0.04) << solver;
  }
}

TEST(Planar, ViscosityHasTheFactorOfThePlane) {
  v1::Simulation simulation = planarColumn(4, 4);
  EXPECT_FLOAT_EQ(Mixture(simulation).friction({}, 1).strength[0][0], 8 * 0.01F);
  simulation.set_planar(false);
  EXPECT_FLOAT_EQ(Mixture(simulation).friction({}, 1).strength[0][0], 10 * 0.01F);
}

void expectRefused(const v1::Simulation& settings, const std::string& fieldPath) {
  try {
    const FluidSimulation simulation(settings);
    FAIL() << "taken, though " << fieldPath << " leads out of the plane";
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), fieldPath);
    EXPECT_THAT(error.problem(), testing::HasSubstr("planar"));
  }
}

TEST(Planar, WhatLeadsOutOfThePlaneIsRefused) {
  v1::Simulation settings = planarColumn(4, 4);
  settings.mutable_gravity()->set_z(1);
  expectRefused(settings, "simulation.gravity.z");
  settings = planarColumn(4, 4);
  v1::Block* block = settings.mutable_fluids(0)->mutable_blocks(0);
  block->set_count_z(2);
  expectRefused(settings, "simulation.fluids[0].blocks[0].count_z");
  block->set_count_z(1);
  block->mutable_velocity()->set_z(1);
  expectRefused(settings, "simulation.fluids[0].blocks[0].velocity.z");
  block->clear_velocity();
  v1::Block other = *block;
  other.mutable_first_particle()->set_y(0.6);
  other.mutable_first_particle()->set_z(0.12);
  settings.mutable_container()->mutable_max()->set_y(1);
  *settings.mutable_fluids(0)->add_blocks() = other;
  expectRefused(settings, "simulation.fluids[0].blocks[1].first_particle.z");
}

// A lattice is in balance beside walls and in corners too: it neither sinks nor is it stirred.
TEST(Planar, ALatticeStaysWhereItIs) {
  FluidSimulation simulation(planarColumn(12, 24));
  runUntil(simulation, 0.5);
  ASSERT_EQ(simulation.halted(), "");
  double squares = 0;
  double highest = 0;
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    const Float4& v = simulation.state().velocity[i];
    squares += v.x * v.x + v.y * v.y + v.z * v.z;
    highest = std::max(highest, static_cast<double>(simulation.state().position[i].y));
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(simulation.state().size())), 0.02 * std::sqrt(9.81 * 1.2));
  EXPECT_NEAR(highest, 1.2, 0.01);
}

}  // namespace
}  // namespace sluice::sim
