#include "sluice/sim/experiment.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

using testing::HasSubstr;

/// A planar box of 1 m without gravity and particles.
v1::Simulation emptyPlane(double spacing) {
  v1::Simulation settings;
  settings.set_planar(true);
  settings.set_particle_spacing(spacing);
  settings.mutable_gravity()->set_y(0);
  settings.mutable_container()->mutable_min()->set_z(-0.2);
  v1::Vec3* max = settings.mutable_container()->mutable_max();
  max->set_x(1);
  max->set_y(1);
  max->set_z(0.2);
  settings.add_fluids()->set_viscosity(0.01);
  return settings;
}

/// The lattice that fills a period, moved along by `shift`, with a shear flow.
Experiment periodicLattice(int across, const Eigen::Vector3d& shift = {0, 0, 0}) {
  Experiment experiment;
  experiment.periodic = true;
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < across; ++i) {
      Eigen::Vector3d x = Eigen::Vector3d((i + 0.5) / across, (j + 0.5) / across, 0) + shift;
      for (int axis = 0; axis < 2; ++axis) x[axis] -= std::floor(x[axis]);
      experiment.positions.push_back(x);
      experiment.velocities.emplace_back(0.3 * std::sin(2 * M_PI * (j + 0.5) / across), 0, 0);
    }
  }
  return experiment;
}

FluidSimulation simulate(const v1::Simulation& settings, Experiment experiment, int threads = 1) {
  return FluidSimulation(settings,
                         {.threads = threads, .experiment = std::make_shared<const Experiment>(std::move(experiment))});
}

TEST(Experiment, APeriodicLatticeHasTheRestDensityEverywhere) {
  FluidSimulation simulation = simulate(emptyPlane(0.05), periodicLattice(20));
  for (std::size_t i = 0; i < simulation.state().size(); ++i) {
    EXPECT_NEAR(simulation.neighbours().density()[i], 1, 1e-4) << i;
    // Those at exactly the support count or not by rounding, and weigh nothing.
    EXPECT_GE(simulation.neighbours().neighbours()[i], 8) << i;
  }
}

// Where the box is cut is of no importance: the flow, moved by a third of the box, is the same flow.
TEST(Experiment, APeriodicFlowDoesNotKnowWhereItsBoxIsCut) {
  const Eigen::Vector3d shift(0.35, 0.2, 0);
  FluidSimulation here = simulate(emptyPlane(0.05), periodicLattice(20));
  FluidSimulation there = simulate(emptyPlane(0.05), periodicLattice(20, shift));
  runUntil(here, 0.2);
  runUntil(there, 0.2);
  const auto a = here.snapshot();
  const auto b = there.snapshot();
  std::vector<Eigen::Vector3f> velocities(a->size());
  for (std::size_t i = 0; i < b->size(); ++i) velocities[b->ids[i]] = b->velocities[i];
  double largest = 0;
  for (std::size_t i = 0; i < a->size(); ++i) {
    largest = std::max(largest, static_cast<double>((velocities[a->ids[i]] - a->velocities[i]).norm()));
  }
  // Positions are rounded differently, and the order of summing is another: of 0.3 m/s.
  EXPECT_LT(largest, 1e-4);
}

TEST(Experiment, ParticlesComeInAgainAtTheOtherSide) {
  Experiment experiment;
  experiment.periodic = true;
  experiment.positions = {{0.9, 0.1, 0}};
  experiment.velocities = {{1, -1, 0}};
  FluidSimulation simulation = simulate(emptyPlane(0.05), std::move(experiment));
  simulation.stopAt(0.25);
  while (simulation.time() < 0.25) ASSERT_TRUE(simulation.advance());
  EXPECT_NEAR(simulation.state().position[0].x, 0.15, 1e-5);
  EXPECT_NEAR(simulation.state().position[0].y, 0.85, 1e-5);
  EXPECT_EQ(simulation.wallContacts(), 0U);
}

TEST(Experiment, AForceFieldActsBesideGravity) {
  v1::Simulation settings = emptyPlane(0.05);
  settings.mutable_gravity()->set_x(0.5);
  Experiment experiment;
  experiment.positions = {{0.5, 0.5, 0}};
  experiment.acceleration = [](const Eigen::Vector3d& x, double) { return Eigen::Vector3d(0, 2 * x.x(), 0); };
  FluidSimulation simulation = simulate(settings, std::move(experiment));
  ASSERT_TRUE(simulation.advance());
  const double dt = simulation.statistics().timeStepSeconds;
  EXPECT_NEAR(simulation.state().velocity[0].x, 0.5 * dt, 1e-7);
  EXPECT_NEAR(simulation.state().velocity[0].y, dt, 1e-7);
}

TEST(Experiment, TheSameBitsForAnyNumberOfThreads) {
  FluidSimulation one = simulate(emptyPlane(0.02), periodicLattice(50), 1);
  FluidSimulation four = simulate(emptyPlane(0.02), periodicLattice(50), 4);
  for (int step = 0; step < 20; ++step) {
    ASSERT_TRUE(one.advance());
    ASSERT_TRUE(four.advance());
  }
  EXPECT_TRUE(one.state() == four.state());
}

TEST(Experiment, WhatCannotBeSimulatedIsRefused) {
  const auto problemOf = [](Experiment experiment, double spacing = 0.05) -> std::string {
    try {
      simulate(emptyPlane(spacing), std::move(experiment));
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(problemOf({.positions = {{0.5, NAN, 0}}}), HasSubstr("experiment.positions[0]"));
  EXPECT_THAT(problemOf({.positions = {{0.5, 0.5, 0}, {1.5, 0.5, 0}}}), HasSubstr("experiment.positions[1]"));
  EXPECT_THAT(problemOf({.positions = {{0.5, 0.5, 0.1}}}), HasSubstr("plane"));
  EXPECT_THAT(problemOf({.positions = {{0.5, 0.5, 0}}, .velocities = {{INFINITY, 0, 0}}}),
              HasSubstr("experiment.velocities[0]"));
  Experiment narrow{.positions = {{0.5, 0.5, 0}}};
  narrow.periodic = true;
  EXPECT_THAT(problemOf(narrow, 0.2), HasSubstr("simulation.container.max"));
}

}  // namespace
}  // namespace sluice::sim
