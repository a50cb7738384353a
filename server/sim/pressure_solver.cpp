#include "pressure_solver.h"

#include "dfsph_solver.h"
#include "iisph_solver.h"
#include "pbf_solver.h"
#include "wcsph_solver.h"

namespace sluice::sim {

void PressureSolver::reset(ParticleState&, const Container&) {}

std::unique_ptr<PressureSolver> makePressureSolver(const v1::Simulation& simulation) {
  switch (simulation.pressure_solver_case()) {
    case v1::Simulation::kIisph:
      return std::make_unique<IisphSolver>(simulation);
    case v1::Simulation::kPbf:
      return std::make_unique<PbfSolver>(simulation);
    case v1::Simulation::kWcsph:
      return std::make_unique<WcsphSolver>(simulation);
    default:
      return std::make_unique<DfsphSolver>(simulation);
  }
}

}  // namespace sluice::sim
