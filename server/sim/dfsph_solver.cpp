#include "dfsph_solver.h"

#include <cmath>

#include "density_solve.h"
#include "pressure_factors.h"
#include "sluice/core/check.h"

namespace sluice::sim {

namespace {

// Share of the last step's impulses that a solve starts from.
constexpr double kDensityWarmStart = 0.5;
constexpr double kDivergenceWarmStart = 0.5;

/// Fewer neighbours than this mark a free surface, where divergence is no sign of compression: 20 in three dimensions,
/// 7 in two [BK17], of a support of two spacings; others hold more particles.
std::uint16_t fullNeighbourhood(const Discretisation& discretisation) {
  const int ofTwoSpacings = discretisation.dimensions == 2 ? 7 : 20;
  const double ratio = discretisation.support / (2 * discretisation.spacing);
  return static_cast<std::uint16_t>(std::lround(ofTwoSpacings * std::pow(ratio, discretisation.dimensions)));
}

}  // namespace

void DfsphSolver::reset(ParticleState& state, const Container&) { state.divergenceImpulse.assign(state.size(), 0); }

void DfsphSolver::run(Stage stage, StepContext& step) {
  switch (stage) {
    case Stage::DivergenceSolve:
      return solveDivergence(step);
    case Stage::DensitySolve:
      return solveDensity(solve_,
                          {.tolerance = settings_.density_error() / 100,
                           .maxIterations = settings_.max_iterations(),
                           .warmStart = settings_.warm_start() ? kDensityWarmStart : 0,
                           .iterationsField = "simulation.dfsph.max_iterations"},
                          factor_, step);
    case Stage::Factors:
      return computeFactors(step);
    default:
      SLUICE_CHECK(!"a stage of DFSPH");
  }
}

void DfsphSolver::solveDivergence(StepContext& step) {
  SolveGoal goal;
  goal.seconds = step.seconds;
  goal.bodies = step.coupling();
  goal.tolerance = settings_.divergence_error() / 100;
  goal.maxIterations = settings_.max_iterations();
  goal.relaxation *= step.discretisation.relaxationScale;
  warmStart(step.state.divergenceImpulse, settings_.warm_start() ? kDivergenceWarmStart : 0, step);
  const SolveOutcome outcome = solve_.run(goal, step.lists, step.mixture.mobility(step.state.fluid), divergenceFactor_,
                                          step.state.velocity, step.state.divergenceImpulse, step.team);
  step.statistics.divergenceIterations = outcome.iterations;
}

void DfsphSolver::computeFactors(const StepContext& step) {
  computePressureFactors(step, factor_);
  divergenceFactor_.resize(factor_.size());
  const std::uint16_t full = fullNeighbourhood(step.discretisation);
  step.team.forEachChunk(factor_.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      divergenceFactor_[i] = step.lists.neighbours()[i] >= full ? factor_[i] : 0;
    }
  });
}

std::uint64_t DfsphSolver::bytes() const {
  return solve_.bytes() + (factor_.size() + divergenceFactor_.size()) * sizeof(float);
}

}  // namespace sluice::sim
