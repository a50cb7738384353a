#include "stability/tension_stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solvers/scenes.h"

namespace sluice::evaluate {

namespace {

/// A rectangle that turns at `spin` rad/s in an empty plane: held together by pressures below 0 alone.
Trial turning(double width, double height, double spacing, double spin, bool negativePressure) {
  Trial trial;
  trial.simulation = planarScene(spacing, {-3, -3, 3, 3});
  const double tip = 0.5 * spin * std::hypot(width, height);
  setSpeedOfSound(trial.simulation, 10 * tip, negativePressure);
  trial.experiment.positions = latticePoints(0.5 * width, 0.5 * height, spacing, [&](const Eigen::Vector3d& x) {
    return std::abs(x.x()) < 0.5 * width && std::abs(x.y()) < 0.5 * height;
  });
  for (const Eigen::Vector3d& x : trial.experiment.positions) {
    trial.experiment.velocities.emplace_back(spin * x.y(), -spin * x.x(), 0);
  }
  trial.speedLimit = 2 * tip;
  trial.steps = 400;
  return trial;
}

/// Vortices of 1 m/s in a periodic box.
Trial vortices(bool negativePressure) {
  constexpr int kAcross = 25;
  constexpr double kSpacing = 1.0 / kAcross;
  constexpr double kWave = 2 * std::numbers::pi;
  Trial trial;
  trial.simulation = planarScene(kSpacing, {0, 0, 1, 1});
  trial.simulation.mutable_time_step()->set_max_seconds(2e-3);
  setSpeedOfSound(trial.simulation, 10, negativePressure);
  trial.experiment.periodic = true;
  trial.experiment.positions = block(kSpacing, 0.5, kAcross, kAcross);
  for (const Eigen::Vector3d& x : trial.experiment.positions) {
    trial.experiment.velocities.emplace_back(-std::cos(kWave * x.x()) * std::sin(kWave * x.y()),
                                             std::sin(kWave * x.x()) * std::cos(kWave * x.y()), 0);
  }
  // What they start with; single particles that stagnation lines throw out are faster than the vortices.
  trial.energyLimit = 1.1 * 0.25;
  trial.seconds = 0.5;
  trial.steps = 2000;
  return trial;
}

double meanDensity(const core::ParticleSnapshot& particles) {
  double sum = 0;
  for (const float density : particles.densities) sum += density;
  return sum / static_cast<double>(particles.densities.size());
}

/// The mean density of the particles where they start, as the method sees it after a step.
double startingDensity(Trial trial, const Method& method, int threads) {
  trial.steps = 1;
  return meanDensity(*attempt(trial, method, threads).end);
}

std::vector<Row> tensionRow(const std::string& name, const Trial& trial, const Method& method, bool clamped,
                            int threads) {
  SolverOutcome outcome = attempt(trial, method, threads);
  const TensileState state = tensileState(*outcome.end, startingDensity(trial, method, threads));
  if (outcome.message.empty()) outcome.message = state.text(clamped);
  Row row = toRow(name, method.solver(), outcome, isHonest(outcome));
  row.set("density_lost", state.densityLost);
  row.set("nearest", state.nearest);
  return {row};
}

}  // namespace

std::string TensileState::text(bool clamped) const {
  // A lattice that shears passes 0.8 without harm, and one in three of a coarse drop's particles is at its surface.
  constexpr double kClumped = 0.8;
  constexpr double kApart = 0.1;
  std::string text;
  if (densityLost > kApart) {
    text = "comes apart, " + shortText(100 * densityLost) + " % of the density lost";
    if (clamped) text += ": pressures below 0 are clamped";
  }
  if (nearest < kClumped) {
    if (!text.empty()) text += "; ";
    text += "clumps, nearest neighbours at " + shortText(nearest) + " d: tensile instability";
  }
  return text;
}

TensileState tensileState(const core::ParticleSnapshot& particles, double meanDensityBefore) {
  TensileState state;
  state.densityLost = 1 - meanDensity(particles) / meanDensityBefore;
  double sum = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    float least = std::numeric_limits<float>::max();
    for (std::size_t j = 0; j < particles.size(); ++j) {
      if (j != i) least = std::min(least, (particles.positions[j] - particles.positions[i]).squaredNorm());
    }
    sum += std::sqrt(least);
  }
  state.nearest = sum / (static_cast<double>(particles.size()) * particles.spacing);
  return state;
}

std::vector<StabilityJob> tensionJobs(int threads) {
  struct TensionCase {
    std::string name;
    std::function<Trial(bool negativePressure)> trial;
  };
  const std::vector<TensionCase> cases{
      {"rotating square", [](bool negative) { return turning(1, 1, 0.05, 1, negative); }},
      {"thin sheet that turns", [](bool negative) { return turning(2, 0.2, 0.05, 1, negative); }},
      {"Taylor-Green vortices", vortices}};
  std::vector<StabilityJob> jobs;
  for (const TensionCase& c : cases) {
    for (const Method& method : solverMethods(true)) {
      // The others clamp, whatever is asked for.
      const bool mayPull = method.courant > 0;
      for (const bool clamped : mayPull ? std::vector<bool>{false, true} : std::vector<bool>{true}) {
        const std::string name = c.name + (clamped ? ", pressures clamped at 0" : ", pressures below 0");
        jobs.push_back({name + ", " + method.solver(),
                        [=] { return tensionRow(name, c.trial(!clamped), method, clamped, threads); }});
      }
    }
  }
  return jobs;
}

}  // namespace sluice::evaluate
