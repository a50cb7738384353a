// Viscous flows of Morris et al. 1997 and the decaying vortices of Taylor & Green, in periodic boxes.

#include <cmath>
#include <numbers>

#include "solvers/run.h"
#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

using std::numbers::pi;

// Channels are 1 m wide and as slow as those of Morris et al. 1997 in their units: Re = 1.25e-2.
constexpr double kViscosity = 0.1;
constexpr double kReynolds = 1.25e-2;
constexpr double kTopSpeed = kReynolds * kViscosity;

// In units of the width squared over the viscosity: most of the way to the steady profile.
constexpr double kEnd = 0.225;

/// Poiseuille flow, started from rest by an acceleration F = 8 ν V0/L². At y, m, after the time t ν/L².
double poiseuille(double y, double time) {
  const double force = 8 * kViscosity * kTopSpeed;
  double u = force / (2 * kViscosity) * y * (1 - y);
  for (int n = 0; n < 50; ++n) {
    const double k = pi * (2 * n + 1);
    u -= 4 * force / (kViscosity * k * k * k) * std::sin(k * y) * std::exp(-k * k * time);
  }
  return u;
}

/// Couette flow, started by a wall at y = L that is moved at V0.
double couette(double y, double time) {
  double u = kTopSpeed * y;
  for (int n = 1; n < 100; ++n) {
    const double sign = n % 2 == 0 ? 1 : -1;
    u += 2 * kTopSpeed / (n * pi) * sign * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * time);
  }
  return u;
}

/// A strip of two channels above one another, periodic along both axes; y = 0 and y = L are lines of symmetry.
v1::Simulation channels(int across, double spacing, int columns) {
  v1::Simulation simulation = planarScene(spacing, {0, -across * spacing, columns * spacing, across * spacing});
  useWendland(simulation, 4);
  simulation.mutable_fluids(0)->set_viscosity(kViscosity);
  // Ten times the flow's; what bounds the step is viscosity.
  setSpeedOfSound(simulation, 10 * kTopSpeed, false);
  return simulation;
}

constexpr int kColumns = 14;

/// The lattice of the strip, particles half a spacing from the lines of symmetry.
sim::Experiment lattice(int across, double spacing) {
  sim::Experiment experiment{.positions = block(spacing, 0.5, kColumns, 2 * across)};
  for (Eigen::Vector3d& x : experiment.positions) x.y() -= across * spacing;
  experiment.periodic = true;
  return experiment;
}

/// Two channels with opposite forces hold each other: u is odd about both walls, which keeps it 0 there
/// [Backer et al. 2005].
std::vector<Finding> poiseuilleFlow(Run& run) {
  const int across = run.resolution();
  const double spacing = 1.0 / across;
  sim::Experiment experiment = lattice(across, spacing);
  const double force = 8 * kViscosity * kTopSpeed;
  experiment.acceleration = [force](const Eigen::Vector3d& x, double) {
    return Eigen::Vector3d(x.y() > 0 ? force : -force, 0, 0);
  };
  run.start(channels(across, spacing, kColumns), std::move(experiment));
  if (!run.runTo(kEnd / kViscosity)) return {};
  const auto particles = run.particles();
  RelativeL2 error;
  for (std::size_t i = 0; i < particles->size(); ++i) {
    const double y = particles->positions[i].y();
    error.add(particles->velocities[i].x(), std::copysign(poiseuille(std::abs(y), kEnd), y));
  }
  return {{"L2 of velocity", error.value(), "Morris et al. 1997, series; walls by symmetry, Backer et al. 2005"}};
}

/// Couette flow less its steady profile V0 y/L, which friction leaves alone: a saw tooth that decays, odd about both
/// walls and 0 there.
std::vector<Finding> couetteFlow(Run& run) {
  const int across = run.resolution();
  const double spacing = 1.0 / across;
  sim::Experiment experiment = lattice(across, spacing);
  for (const Eigen::Vector3d& x : experiment.positions) experiment.velocities.emplace_back(-kTopSpeed * x.y(), 0, 0);
  run.start(channels(across, spacing, kColumns), std::move(experiment));
  if (!run.runTo(kEnd / kViscosity)) return {};
  const auto particles = run.particles();
  RelativeL2 error;
  for (std::size_t i = 0; i < particles->size(); ++i) {
    const double y = std::abs(particles->positions[i].y());
    const double side = particles->positions[i].y() > 0 ? 1 : -1;
    const double decaying = side * particles->velocities[i].x();
    error.add(decaying + kTopSpeed * y, couette(y, kEnd));
  }
  return {{"L2 of velocity", error.value(), "Morris et al. 1997, series; less the steady shear, walls by symmetry"}};
}

/// Vortices of 1 m/s in a square of 1 m at Re = 100, whose speed decays by exp(-8π² t/Re).
std::vector<Finding> taylorGreen(Run& run) {
  constexpr double kRe = 100;
  constexpr double kUntil = 0.5;
  const int across = run.resolution();
  const double spacing = 1.0 / across;
  v1::Simulation simulation = planarScene(spacing, {0, 0, 1, 1});
  useWendland(simulation, 3);
  simulation.mutable_fluids(0)->set_viscosity(1 / kRe);
  setSpeedOfSound(simulation, 10, true);
  sim::Experiment experiment{.positions = block(spacing, 0.5, across, across)};
  experiment.periodic = true;
  const auto flow = [](double x, double y) {
    return Eigen::Vector3d(-std::cos(2 * pi * x) * std::sin(2 * pi * y), std::sin(2 * pi * x) * std::cos(2 * pi * y),
                           0);
  };
  for (const Eigen::Vector3d& x : experiment.positions) experiment.velocities.push_back(flow(x.x(), x.y()));
  run.start(simulation, std::move(experiment));
  const double before = planeMoments(*run.particles()).kinetic;
  if (!run.runTo(kUntil)) return {};
  const auto particles = run.particles();
  const double decay = std::exp(-8 * pi * pi / kRe * kUntil);
  double difference = 0;
  double exact = 0;
  for (std::size_t i = 0; i < particles->size(); ++i) {
    const Eigen::Vector3f& x = particles->positions[i];
    const double speed = decay * flow(x.x(), x.y()).norm();
    difference += std::abs(particles->velocities[i].norm() - speed);
    exact += speed;
  }
  const double rate = std::log(planeMoments(*particles).kinetic / before) / (2 * kUntil);
  return {{"L1 of speed", difference / exact, "Taylor & Green 1937"},
          {"decay rate", std::abs(rate / (-8 * pi * pi / kRe) - 1), "Taylor & Green 1937"}};
}

}  // namespace

std::vector<Case> viscousCases() {
  return {{"poiseuille", {25, 50}, {25, 50, 100}, everySolver, poiseuilleFlow},
          {"couette", {25, 50}, {25, 50, 100}, everySolver, couetteFlow},
          {"taylor-green", {25, 50}, {25, 50, 100, 200}, everySolver, taylorGreen}};
}

}  // namespace sluice::evaluate
