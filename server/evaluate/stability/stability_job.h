#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sluice/evaluate/report.h"
#include "stability/solver_outcome.h"

namespace sluice::evaluate {

/// A piece of the stability study that is run, kept and resumed as a whole.
struct StabilityJob {
  std::string name;  ///< For the progress bar, and the key that its rows are kept by: no two jobs share it.
  std::function<std::vector<Row>()> run;
};

/// Whether an outcome is an honest one: the simulation went on, or said why it could not. Never a burst in silence.
bool isHonest(const SolverOutcome& outcome);

/// The trial with every solver at its default, a job each, which passes where the outcome is honest.
void addForEverySolver(std::vector<StabilityJob>& jobs, const std::string& name, const Trial& trial, int threads);

/// The trial with one solver.
StabilityJob solverJob(const std::string& name, const Trial& trial, const Method& method, int threads);

}  // namespace sluice::evaluate
