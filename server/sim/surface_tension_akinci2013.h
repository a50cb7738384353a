#pragma once

#include <vector>

#include "surface_tension.h"

namespace sluice::sim {

/// Cohesion and evening out of curvature [AAT13: Akinci et al. 2013, Versatile surface tension and adhesion for SPH
/// fluids]: F_i = Σ_j K_ij [-γ m_i m_j C(|x_ij|) x_ij/|x_ij| - γ m_i (n_i - n_j)], K_ij = 2ρ0/(ρ_i + ρ_j), n_i = H Σ_j
/// V_j ∇W_ij, between particles of one fluid. Forces are pairwise and opposite: momentum is kept.
///
/// γ is no surface tension. It is chosen such that the attraction of two half-spaces of uniform density makes the
/// surface tension that the scene asks for (Rayleigh 1890): σ = π/8 n² ∫ r⁴ f(r) dr of n particles a volume that
/// attract each other with f = γ m² C; in two dimensions, σ = 1/3 n² ∫ r³ f(r) dr. The curvature term then has the
/// weight that it has in the paper for water in SI units.
class Akinci2013Tension : public SurfaceTension {
 public:
  void apply(const v1::SurfaceTension& settings, StepContext& step) override;
  std::uint64_t bytes() const override;

 private:
  ColourGradient normals_;
  std::vector<Float4> places_;  ///< Positions, and densities in the fourth lane.
  std::vector<Float4> result_;
};

}  // namespace sluice::sim
