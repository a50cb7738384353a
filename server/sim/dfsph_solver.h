#pragma once

#include <vector>

#include "jacobi_solve.h"
#include "pressure_solver.h"

namespace sluice::sim {

/// Divergence-free SPH [BK17: Bender & Koschier 2017, Divergence-free SPH for incompressible and viscous fluids]: one
/// solve takes compressing motion out of the velocities before the forces act, another keeps the density at rest after
/// the move.
class DfsphSolver : public PressureSolver {
 public:
  explicit DfsphSolver(const v1::Simulation& simulation) : settings_(simulation.dfsph()) {}

  void reset(ParticleState& state, const Container& container) override;
  void update(const v1::Simulation& simulation) override { settings_ = simulation.dfsph(); }
  void run(Stage stage, StepContext& step) override;
  WallAnswer wallAnswer() const override { return WallAnswer::Mirrored; }
  std::uint64_t bytes() const override;

 private:
  void solveDivergence(StepContext& step);
  void computeFactors(const StepContext& step);

  v1::Dfsph settings_;
  JacobiSolve solve_;
  std::vector<float> factor_;            ///< α_i, m².
  std::vector<float> divergenceFactor_;  ///< α_i, 0 near a free surface.
};

}  // namespace sluice::sim
