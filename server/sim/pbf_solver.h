#pragma once

#include <vector>

#include "pressure_solver.h"

namespace sluice::sim {

/// Position-based fluids [MM13: Macklin & Müller 2013]: after the particles have moved, their positions are corrected a
/// few times until the constraints C_i = ρ̃_i - 1 ≤ 0 nearly hold, each time with densities and gradients of where they
/// then are; what moved them also changes their velocities. Corrections are λ_i = -C_i/Σ_k |∇_k C_i|² as in [MM13],
/// without its softening ε, which the relaxation makes needless, and without its artificial pressure.
class PbfSolver : public PressureSolver {
 public:
  explicit PbfSolver(const v1::Simulation& simulation) : settings_(simulation.pbf()) {}

  void update(const v1::Simulation& simulation) override { settings_ = simulation.pbf(); }
  void run(Stage stage, StepContext& step) override;
  bool movesParticles() const override { return true; }
  std::uint64_t bytes() const override;

 private:
  void correct(StepContext& step);

  v1::Pbf settings_;
  std::vector<float> factor_;     ///< α_i, m².
  std::vector<Float4> impulse4_;  ///< Of one correction, m²/s, in all four lanes for the pair loops.
  std::vector<Float4> corrected_;
};

}  // namespace sluice::sim
