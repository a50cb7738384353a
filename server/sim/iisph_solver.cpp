#include "iisph_solver.h"

#include "density_solve.h"
#include "pressure_factors.h"
#include "sluice/core/check.h"

namespace sluice::sim {

namespace {

// Share of the last step's pressures that the solve starts from [Ihmsen et al. 2014].
constexpr double kWarmStart = 0.5;

}  // namespace

void IisphSolver::run(Stage stage, StepContext& step) {
  switch (stage) {
    case Stage::DensitySolve:
      return solveDensity(solve_,
                          {.tolerance = settings_.density_error() / 100,
                           .maxIterations = settings_.max_iterations(),
                           .relaxation = settings_.relaxation(),
                           .warmStart = kWarmStart,
                           .iterationsField = "simulation.iisph.max_iterations"},
                          factor_, step);
    case Stage::Factors:
      return computePressureFactors(step, factor_);
    default:
      SLUICE_CHECK(!"a stage of IISPH");
  }
}

}  // namespace sluice::sim
