#include "solvers/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sluice/core/check.h"
#include "sluice/sim/simulation.h"

namespace sluice::evaluate {

void Run::start(v1::Scene scene) {
  choose(*scene.mutable_simulation(), method_);
  adopt(sim::makeSimulation(scene, threads_));
}

void Run::start(v1::Simulation simulation) {
  v1::Scene scene;
  *scene.mutable_simulation() = std::move(simulation);
  start(std::move(scene));
}

void Run::start(v1::Simulation simulation, sim::Experiment experiment) {
  choose(simulation, method_);
  v1::Scene scene;
  *scene.mutable_simulation() = simulation;
  adopt(sim::makeExperiment(scene, std::move(experiment), threads_));
}

void Run::adopt(std::unique_ptr<core::ParticleSource> source) {
  source_ = std::move(source);
  const auto start = source_->snapshot();
  spacing_ = start->spacing;
  particleCount_ = start->size();
}

bool Run::runTo(double seconds, const std::function<void(const core::ParticleSource&)>& each) {
  using Clock = std::chrono::steady_clock;
  source_->stopAt(seconds);
  while (source_->time() < seconds) {
    const auto start = Clock::now();
    const bool advanced = source_->advance();
    wallSeconds_ += std::chrono::duration<double>(Clock::now() - start).count();
    if (!advanced) return false;
    ++steps_;
    const core::StepStatistics statistics = source_->statistics();
    iterations_ += statistics.densityIterations + statistics.divergenceIterations + statistics.viscosityIterations;
    if (each) each(*source_);
  }
  return true;
}

const std::vector<Case>& solverCases() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> all;
    for (auto* family : {restCases, viscousCases, damBreakCases, boxImpactCases, freeSurfaceCases, tensionCases,
                         waveCases, conservationCases}) {
      std::ranges::move(family(), std::back_inserter(all));
    }
    return all;
  }();
  return cases;
}

const Case& solverCase(std::string_view name) {
  const auto found = std::ranges::find(solverCases(), name, &Case::name);
  SLUICE_CHECK(found != solverCases().end());
  return *found;
}

}  // namespace sluice::evaluate
