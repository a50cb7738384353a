#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sluice/core/particle_source.h"
#include "sluice/evaluate/report.h"
#include "sluice/sim/experiment.h"
#include "solvers/method.h"

namespace sluice::evaluate {

/// What became of a simulation.
enum class Fate {
  Stable,
  Recovered,  ///< By shorter steps than the first that was tried.
  Stopped,    ///< With a message, its last good state kept.
  Refused,    ///< Before it began, with a message.
  Bursts,     ///< Faster, or of more energy, than what drives it can make it, or a body out of the container, without a
              ///< message.
  NotFinite,  ///< Never right.
};

struct SolverOutcome {
  Fate fate = Fate::Stable;
  std::string message;      ///< Of a simulation that stopped or was refused.
  double fastest = 0;       ///< Largest speed of any particle, m/s.
  double compression = 0;   ///< Largest compression of any particle.
  double iterations = 0;    ///< Of the pressure solves, a step.
  double shortestStep = 0;  ///< s.
  /// The particles at the end; null where there was no beginning.
  std::shared_ptr<const core::ParticleSnapshot> end = {};

  std::string word() const;  ///< "stable", "recovered", "stopped" (or refused), "bursts", "not finite".
  std::string text() const;  ///< The word with its reason: "stopped: …".
};

/// What a solver is given: a scene, and an experiment unless it has none.
struct Trial {
  v1::Simulation simulation;
  sim::Experiment experiment;
  bool isExperiment = true;
  std::vector<v1::Body> bodies = {};  ///< Of what is no experiment.
  int steps = 100;                    ///< At most.
  double seconds = 0;  ///< To run to, s, so that solvers of short steps see as much as others; 0: all of the steps.
  /// Speed that nothing in it can have unless it bursts, m/s.
  double speedLimit = 1e30;
  /// Mean kinetic energy of the fluid, J/kg, that nothing in it can give: what is there to begin with, and falls.
  double energyLimit = 1e30;
  std::function<void(core::ParticleSource&)> halfWay = {};  ///< Called after half of the steps.
};

SolverOutcome attempt(Trial trial, const Method& method, int threads);

/// case, solver, outcome (a word), message, fastest, compression, iterations_per_step, shortest_step, passed.
Row toRow(const std::string& caseName, const std::string& solver, const SolverOutcome& outcome, bool passed);

}  // namespace sluice::evaluate
