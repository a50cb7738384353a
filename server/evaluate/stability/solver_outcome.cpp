#include "stability/solver_outcome.h"

#include <algorithm>
#include <cmath>

#include "sluice/core/input_error.h"
#include "sluice/sim/simulation.h"

namespace sluice::evaluate {

namespace {

std::unique_ptr<core::ParticleSource> open(const Trial& trial, const Method& method, int threads) {
  v1::Scene scene;
  *scene.mutable_simulation() = trial.simulation;
  choose(*scene.mutable_simulation(), method);
  if (!trial.isExperiment) return sim::makeSimulation(scene, threads);
  return sim::makeExperiment(scene, trial.experiment, threads);
}

bool isFinite(const core::ParticleSnapshot& particles) {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!particles.positions[i].allFinite() || !particles.velocities[i].allFinite()) return false;
  }
  return true;
}

}  // namespace

std::string SolverOutcome::text() const {
  switch (fate) {
    case Fate::Stable:
      return "stable";
    case Fate::Recovered:
      return "recovered by smaller steps";
    case Fate::Stopped:
      return "stopped: " + message;
    case Fate::Refused:
      return "refused: " + message;
    case Fate::Bursts:
      return "bursts";
    case Fate::NotFinite:
      break;
  }
  return "not finite";
}

SolverOutcome attempt(Trial trial, const Method& method, int threads) {
  SolverOutcome outcome;
  std::unique_ptr<core::ParticleSource> source;
  try {
    source = open(trial, method, threads);
  } catch (const core::InputError& error) {
    outcome.fate = Fate::Refused;
    outcome.message = error.what();
    return outcome;
  }
  outcome.shortestStep = 1e30;
  int step = 0;
  for (; step < trial.steps; ++step) {
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
    if (statistics.timeStepLimit == "recovery") outcome.fate = Fate::Recovered;
  }
  outcome.iterations /= std::max(step, 1);
  if (outcome.fastest > trial.speedLimit) outcome.fate = Fate::Bursts;
  if (!isFinite(*source->snapshot()) || !std::isfinite(outcome.fastest)) outcome.fate = Fate::NotFinite;
  return outcome;
}

Row toRow(const std::string& caseName, const std::string& solver, const SolverOutcome& outcome, bool passed) {
  return {{"case", caseName},
          {"solver", solver},
          {"outcome", outcome.text()},
          {"fastest", outcome.fastest},
          {"compression", outcome.compression},
          {"iterations_per_step", outcome.iterations},
          {"shortest_step", outcome.shortestStep},
          {"passed", passed}};
}

}  // namespace sluice::evaluate
