#include "stability/solver_outcome.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sluice/core/input_error.h"
#include "sluice/sim/simulation.h"

namespace sluice::evaluate {

namespace {

std::unique_ptr<core::ParticleSource> open(const Trial& trial, const Method& method, int threads) {
  v1::Scene scene;
  *scene.mutable_simulation() = trial.simulation;
  choose(*scene.mutable_simulation(), method);
  for (const v1::Body& body : trial.bodies) *scene.add_bodies() = body;
  if (!trial.isExperiment) return sim::makeSimulation(scene, threads);
  return sim::makeExperiment(scene, trial.experiment, threads);
}

bool isFinite(const core::ParticleSnapshot& particles) {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!particles.positions[i].allFinite() || !particles.velocities[i].allFinite()) return false;
  }
  for (const core::BodyPose& pose : particles.bodies) {
    if (!pose.position.allFinite() || !pose.rotation.coeffs().allFinite()) return false;
  }
  return true;
}

/// Whether the middle of every body is inside of the container, a box.
bool holdsBodies(const v1::Box& box, const core::ParticleSnapshot& particles) {
  return std::ranges::all_of(particles.bodies, [&](const core::BodyPose& pose) {
    const Eigen::Vector3d x = pose.position.cast<double>();
    return x.x() > box.min().x() && x.x() < box.max().x() && x.y() > box.min().y() && x.y() < box.max().y() &&
           x.z() > box.min().z() && x.z() < box.max().z();
  });
}

/// Of all fluids, J/kg.
double kineticEnergy(const core::ParticleSnapshot& particles) {
  double energy = 0;
  double mass = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    // Particles have equal volumes at rest.
    const double own = particles.fluids.empty() ? particles.restDensity : particles.restDensities[particles.fluids[i]];
    energy += 0.5 * own * particles.velocities[i].cast<double>().squaredNorm();
    mass += own;
  }
  return mass > 0 ? energy / mass : 0;
}

}  // namespace

std::string SolverOutcome::word() const {
  switch (fate) {
    case Fate::Stable:
      return "stable";
    case Fate::Recovered:
      return "recovered";
    case Fate::Stopped:
    case Fate::Refused:
      return "stopped";
    case Fate::Bursts:
      return "bursts";
    case Fate::NotFinite:
      break;
  }
  return "not finite";
}

std::string SolverOutcome::text() const { return message.empty() ? word() : word() + ": " + message; }

SolverOutcome attempt(Trial trial, const Method& method, int threads) {
  SolverOutcome outcome;
  std::unique_ptr<core::ParticleSource> source;
  try {
    source = open(trial, method, threads);
  } catch (const core::InputError& error) {
    outcome.fate = Fate::Refused;
    outcome.message = std::string("before the first step: ") + error.what();
    return outcome;
  }
  outcome.shortestStep = 1e30;
  const bool watchesEnergy = trial.energyLimit < Trial().energyLimit;
  const double end = trial.seconds > 0 ? trial.seconds : std::numeric_limits<double>::infinity();
  double energy = 0;
  int step = 0;
  for (; step < trial.steps && source->time() < end; ++step) {
    if (step == trial.steps / 2 && trial.halfWay) trial.halfWay(*source);
    if (!source->advance()) {
      outcome.fate = Fate::Stopped;
      outcome.message = source->halted();
      break;
    }
    const core::StepStatistics statistics = source->statistics();
    outcome.fastest = std::max(outcome.fastest, statistics.maxSpeed);
    outcome.compression = std::max(outcome.compression, statistics.maxDensityError);
    outcome.shortestStep = std::min(outcome.shortestStep, statistics.timeStepSeconds);
    outcome.iterations += statistics.densityIterations + statistics.divergenceIterations;
    if (watchesEnergy) energy = std::max(energy, kineticEnergy(*source->snapshot()));
    if (statistics.timeStepLimit == "recovery") outcome.fate = Fate::Recovered;
  }
  outcome.iterations /= std::max(step, 1);
  const bool stopped = outcome.fate == Fate::Stopped;
  if (step == 0) outcome.shortestStep = 0;
  const bool bursts = outcome.fastest > trial.speedLimit || energy > trial.energyLimit;
  if (!stopped && bursts) outcome.fate = Fate::Bursts;
  outcome.end = source->snapshot();
  if (!stopped && !holdsBodies(trial.simulation.container(), *outcome.end)) outcome.fate = Fate::Bursts;
  if (!isFinite(*outcome.end) || !std::isfinite(outcome.fastest)) outcome.fate = Fate::NotFinite;
  return outcome;
}

Row toRow(const std::string& caseName, const std::string& solver, const SolverOutcome& outcome, bool passed) {
  return {{"case", caseName},
          {"solver", solver},
          {"outcome", outcome.word()},
          {"message", outcome.message},
          {"fastest", outcome.fastest},
          {"compression", outcome.compression},
          {"iterations_per_step", outcome.iterations},
          {"shortest_step", outcome.shortestStep},
          {"passed", passed}};
}

}  // namespace sluice::evaluate
