// Patches of an ideal fluid in free space: what is known of them holds as long as nothing is lost.

#include <cmath>

#include "solvers/run.h"
#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

constexpr Rectangle kSpace{-3, -3, 3, 3};

/// Points of a disc of radius 1 m.
std::vector<Eigen::Vector3d> disc(double spacing) {
  return latticePoints(1, 1, spacing, [](const Eigen::Vector3d& x) { return x.norm() < 1; });
}

double meanDensity(const core::ParticleSnapshot& particles) {
  double sum = 0;
  for (const float density : particles.densities) sum += density;
  return sum / static_cast<double>(particles.size());
}

/// A square of 1 m that turns at 1 rad/s. Nothing holds it together but pressures below 0, which solvers that clamp
/// them at 0 have not.
std::vector<Finding> rotatingSquare(Run& run) {
  constexpr double kUntil = 2;  // rad
  const double spacing = 1.0 / run.resolution();
  v1::Simulation simulation = planarScene(spacing, kSpace);
  setSpeedOfSound(simulation, 10, true);
  sim::Experiment experiment{.positions = latticePoints(0.5, 0.5, spacing, [](const Eigen::Vector3d& x) {
                               return std::max(std::abs(x.x()), std::abs(x.y())) < 0.5;
                             })};
  for (const Eigen::Vector3d& x : experiment.positions) experiment.velocities.emplace_back(x.y(), -x.x(), 0);
  run.start(simulation, std::move(experiment));
  const PlaneMoments before = planeMoments(*run.particles());
  const double dense = meanDensity(*run.particles());
  if (!run.runTo(kUntil)) return {};
  const PlaneMoments after = planeMoments(*run.particles());
  // Four-fold symmetry keeps the tensor of second moments round.
  const double lopsided = std::hypot(after.xx - after.yy, 2 * after.xy) / (after.xx + after.yy);
  return {{"density lost", 1 - meanDensity(*run.particles()) / dense, "kept; what is clamped at p = 0 comes apart"},
          {"angular momentum drift", std::abs(after.spin / before.spin - 1), "kept, Colagrossi 2005"},
          {"kinetic energy drift", std::abs(after.kinetic / before.kinetic - 1), "kept, Colagrossi 2005"},
          {"asymmetry of second moments", lopsided, "four-fold symmetry"}};
}

/// A disc in the strain (-100 x, 100 y): an ellipse of half axes a = 1/b, with b = 1.94452 m at 0.0076 s.
std::vector<Finding> ellipticDrop(Run& run) {
  constexpr double kUntil = 0.0076;
  constexpr double kHalfHeight = 1.94452;
  constexpr double kRate = 70.311;  // A at the end; v = (-A x, A y)
  const double spacing = 1.0 / run.resolution();
  v1::Simulation simulation = planarScene(spacing, kSpace);
  // Ten times the fastest particle's at the start, 100 m/s.
  setSpeedOfSound(simulation, 1400, true);
  sim::Experiment experiment{.positions = disc(spacing)};
  for (const Eigen::Vector3d& x : experiment.positions)
    experiment.velocities.emplace_back(-100 * x.x(), 100 * x.y(), 0);
  run.start(simulation, std::move(experiment));
  const PlaneMoments before = planeMoments(*run.particles());
  if (!run.runTo(kUntil)) return {};
  const PlaneMoments after = planeMoments(*run.particles());
  // The half axis of a uniform ellipse is twice the root of its second moment.
  const double halfHeight = std::sqrt(after.yy / before.yy);
  const double a = 1 / kHalfHeight;
  const double kinetic = std::pow(kRate / 100, 2) * (a * a + kHalfHeight * kHalfHeight) / 2;
  return {{"half height", std::abs(halfHeight / kHalfHeight - 1), "Monaghan 1994, b = 1.94452 m"},
          {"kinetic energy", std::abs(after.kinetic / before.kinetic / kinetic - 1), "Monaghan 1994"}};
}

/// A disc under the force -Ω² x, Ω = 1/s, that starts with the strain (½ x, -½ y): it swings between ellipses of up to
/// √2 m with a period of 4.56737 s.
std::vector<Finding> oscillatingDrop(Run& run) {
  constexpr double kPeriod = 4.56737;
  constexpr double kLongest = 1.41421;
  constexpr double kPeriods = 2;
  const double spacing = 1.0 / run.resolution();
  v1::Simulation simulation = planarScene(spacing, kSpace);
  setSpeedOfSound(simulation, 15, false);
  sim::Experiment experiment{.positions = disc(spacing)};
  for (const Eigen::Vector3d& x : experiment.positions)
    experiment.velocities.emplace_back(0.5 * x.x(), -0.5 * x.y(), 0);
  experiment.acceleration = [](const Eigen::Vector3d& x, double) -> Eigen::Vector3d { return -x; };
  run.start(simulation, std::move(experiment));
  const PlaneMoments before = planeMoments(*run.particles());
  Oscillation lengths;
  double longest = 0;
  const bool done = run.runTo(kPeriods * kPeriod, [&](const core::ParticleSource& source) {
    const PlaneMoments moments = planeMoments(*source.snapshot());
    lengths.add(source.time(), std::log(moments.xx / moments.yy));
    longest = std::max(longest, std::sqrt(moments.xx / before.xx));
  });
  if (!done) return {};
  const PlaneMoments after = planeMoments(*run.particles());
  const auto energy = [](const PlaneMoments& m) { return m.kinetic + 0.5 * (m.xx + m.yy); };
  const double area = std::sqrt((after.xx * after.yy - after.xy * after.xy) / (before.xx * before.yy));
  return {{"period", std::abs(lengths.period() / kPeriod - 1), "ellipse, 4.56737/Omega"},
          {"longest half axis", std::abs(longest / kLongest - 1), "ellipse, sqrt(2) R"},
          {"energy drift", std::abs(energy(after) / energy(before) - 1), "kept"},
          {"area drift", std::abs(area - 1), "kept"}};
}

}  // namespace

std::vector<Case> freeSurfaceCases() {
  return {{"rotating square", {25, 50}, {25, 50, 100}, everySolver, rotatingSquare},
          {"elliptic drop", {20, 40}, {20, 40, 80}, everySolver, ellipticDrop},
          {"oscillating drop", {12, 24}, {12, 24, 48}, everySolver, oscillatingDrop}};
}

}  // namespace sluice::evaluate
