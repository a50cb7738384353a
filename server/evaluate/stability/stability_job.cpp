#include "stability/stability_job.h"

namespace sluice::evaluate {

bool isHonest(const SolverOutcome& outcome) {
  return outcome.fate != Fate::Bursts && outcome.fate != Fate::NotFinite && outcome.fate != Fate::Refused;
}

StabilityJob solverJob(const std::string& name, const Trial& trial, const Method& method, int threads) {
  return {name + ", " + method.solver(), [=]() -> std::vector<Row> {
            const SolverOutcome outcome = attempt(trial, method, threads);
            return {toRow(name, method.solver(), outcome, isHonest(outcome))};
          }};
}

void addForEverySolver(std::vector<StabilityJob>& jobs, const std::string& name, const Trial& trial, int threads) {
  for (const Method& method : solverMethods(true)) jobs.push_back(solverJob(name, trial, method, threads));
}

}  // namespace sluice::evaluate
