#pragma once

#include <vector>

#include "jacobi_solve.h"
#include "pressure_solver.h"

namespace sluice::sim {

/// Implicit incompressible SPH [Ihmsen et al. 2014]: pressures, by relaxed Jacobi iteration from half of the last
/// step's, after which the density predicted for the end of the step is at most that at rest. Nothing is done about
/// compressing motion as such.
///
/// The paper's a_ii p_i + Σ … p_j = ρ0 - ρ_adv, with displacements by d_ij = -dt² m_j/ρ_j² ∇W_ij, is the system of
/// JacobiSolve for κ = p dt/(ρ0 ρ̃²), the walls' share included; dividing out ρ̃² leaves the iterates as they are.
class IisphSolver : public PressureSolver {
 public:
  explicit IisphSolver(const v1::Simulation& simulation) : settings_(simulation.iisph()) {}

  void update(const v1::Simulation& simulation) override { settings_ = simulation.iisph(); }
  void run(Stage stage, StepContext& step) override;
  WallAnswer wallAnswer() const override { return WallAnswer::Mirrored; }
  std::uint64_t bytes() const override { return solve_.bytes() + factor_.size() * sizeof(float); }

 private:
  v1::Iisph settings_;
  JacobiSolve solve_;
  std::vector<float> factor_;  ///< α_i, m².
};

}  // namespace sluice::sim
