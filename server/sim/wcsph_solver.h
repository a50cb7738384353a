#pragma once

#include <array>
#include <vector>

#include "pressure_solver.h"

namespace sluice::sim {

/// Weakly compressible SPH [Monaghan 1994; Becker & Teschner 2007]: pressure follows from density by Tait's equation
/// p = ρ0 c0²/γ (ρ̃^γ - 1), and density from the velocities by the continuity equation, which knows no deficiency at
/// free surfaces. The step is bounded by sound. Velocities move before densities and positions (symplectic Euler), and
/// pressure forces are the adjoint of the density rate, so that what pressure takes from motion it gives back.
///
/// A wall mirrors pressure and velocity of the particle beside it, which counts its share in both twice. With the
/// pressure alone [Akinci et al. 2012] the two are no longer adjoint, and a resting column was seen to go on swinging;
/// with neither, a particle had to be denser beside a wall than elsewhere, and diffusion pressed it on.
///
/// All fluids answer to the same stiffness ρ_max c0²/γ, because pressure is what they share; sound is faster in lighter
/// ones. With density diffusion it is delta-SPH: dρ̃_i/dt has the term δ h c0 Σ_j 2 V_j (A_i - A_j) x_ij·∇W_ij/|x_ij|²
/// [Molteni & Colagrossi 2009], with the density less its hydrostatic part, A = ρ̃ - (ρ0/ρ_max) g·x/c0², as proposed
/// by Fourtakas et al. 2019, to first order in the compression.
class WcsphSolver : public PressureSolver {
 public:
  explicit WcsphSolver(const v1::Simulation& simulation);

  void reset(ParticleState& state, const Container& container) override;
  void update(const v1::Simulation& simulation) override;
  void run(Stage stage, StepContext& step) override;
  double speedOfSound() const override;
  bool mirrorsByItself() const override { return true; }
  std::uint64_t bytes() const override;

 private:
  /// c0, m/s.
  double referenceSpeed() const;
  void applyPressure(StepContext& step);
  void mirrorGradient(const StepContext& step);
  /// Σ_j V_j ∇W_ij + 2 Σ_b V_b ∇W_ib.
  const std::vector<Float4>& gradientWithMirror(const StepContext& step) const;
  void integrateDensity(StepContext& step);
  void diffuseDensity(const StepContext& step);

  v1::Simulation settings_;
  double densityRatio_ = 1;           ///< Heaviest fluid over the lightest.
  double fastestStart_ = 0;           ///< Largest initial speed, of emitters too, m/s.
  std::array<double, 3> fallDown_{};  ///< How far particles may fall towards the lower corner, m,
  std::array<double, 3> fallUp_{};    ///< and towards the upper one.
  std::vector<Float4> impulse4_;      ///< κ/ρ̃², in all four lanes for the pair loops; then positions and A.
  std::vector<Float4> pushed_;
  std::vector<Float4> ones_;
  std::vector<Float4> gradient_;
  std::vector<float> rate_;       ///< dρ̃/dt, 1/s.
  std::vector<float> diffusion_;  ///< Its diffusive part, 1/s.
};

}  // namespace sluice::sim
