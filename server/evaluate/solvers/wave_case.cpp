// A standing wave of small amplitude.

#include <cmath>
#include <numbers>

#include "solvers/run.h"
#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

/// Half a wave of λ = 2 m in water 1 m deep, between walls: ω² = g k tanh kH, T = 1.13392 s. It starts flat, with the
/// velocities of linear theory.
std::vector<Finding> standingWave(Run& run) {
  constexpr double kGravity = 9.81;
  constexpr double kSteepness = 0.05;  // A/H
  constexpr double kViscosity = 1e-6;
  constexpr double kPeriods = 4;
  const double k = std::numbers::pi;
  const double frequency = std::sqrt(kGravity * k * std::tanh(k));
  const double period = 2 * std::numbers::pi / frequency;

  const int layers = run.resolution();
  const double spacing = 1.0 / layers;
  // The fluid reaches half a spacing beyond its outermost particles, which stand one from the faces.
  v1::Simulation simulation = planarScene(spacing, {0, 0, 1 + spacing, 1.5});
  simulation.mutable_gravity()->set_y(-kGravity);
  simulation.mutable_fluids(0)->set_viscosity(kViscosity);
  sim::Experiment experiment{.positions = block(spacing, 1, layers, layers)};
  const double half = 0.5 * spacing;
  for (const Eigen::Vector3d& x : experiment.positions) {
    const double speed = kSteepness * frequency / std::sinh(k);
    experiment.velocities.emplace_back(-speed * std::cosh(k * (x.y() - half)) * std::sin(k * (x.x() - half)),
                                       speed * std::sinh(k * (x.y() - half)) * std::cos(k * (x.x() - half)), 0);
  }
  run.start(simulation, std::move(experiment));
  Oscillation mode;
  const bool done = run.runTo(kPeriods * period, [&](const core::ParticleSource& source) {
    const auto particles = source.snapshot();
    double sum = 0;
    for (const Eigen::Vector3f& x : particles->positions) sum += x.y() * std::cos(k * (x.x() - half));
    mode.add(source.time(), sum);
  });
  if (!done) return {};
  const std::vector<double> peaks = mode.peaks();
  // A swing that viscosity alone damps: exp(-2 ν k² t), next to nothing here.
  const double lost = peaks.size() > 2 ? 1 - peaks.back() / peaks.front() : std::nan("");
  return {{"period", std::abs(mode.period() / period - 1), "linear theory, g k tanh(k H)"},
          {"amplitude lost in 4 periods", lost, "linear theory, ideal fluid"}};
}

}  // namespace

std::vector<Case> waveCases() { return {{"standing wave", {20}, {20, 40, 80}, everySolver, standingWave}}; }

}  // namespace sluice::evaluate
