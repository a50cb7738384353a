#pragma once

#include <vector>

#include "surface_tension.h"

namespace sluice::sim {

/// Energy κ/2 |∇c|² of the colour field's gradient [HWZ14: He et al. 2014, Robust simulation of sparsely sampled thin
/// features in SPH-based free surface flows]: a_i = κ/4ρ0 Σ_j V_j (|∇c_i|² + |∇c_j|²) ∇W_ij, with the rest density
/// where the paper has ρ_i, so that momentum is kept; ∇c_i = 1/ρ̃_i Σ_j V_j ρ̃_j ∇W_ij. Fluids in one another have one
/// colour.
///
/// κ is chosen such that a plane surface, smoothed by the kernel, has the energy per area that the scene asks for as
/// surface tension: σ = κ/2 ∫ (dc/dz)² dz.
class He2014Tension : public SurfaceTension {
 public:
  void apply(const v1::SurfaceTension& settings, StepContext& step) override;
  std::uint64_t bytes() const override;

 private:
  ColourGradient colour_;
  std::vector<Float4> impulse4_;  ///< -κ dt |∇c|²/(4 ρ_max), in all four lanes for the pair loops.
  std::vector<Float4> result_;
};

}  // namespace sluice::sim
