#pragma once

#include <vector>

#include "step_context.h"

namespace sluice::sim {

/// Adhesion of the fluids to walls and bodies [AAT13: Akinci et al. 2013, Versatile surface tension and adhesion for
/// SPH fluids]: F_i = -β m_i Σ_b ρ0 V_b A(|x_ib|) x_ib/|x_ib| over the boundary particles b,
/// A(qH) = 0.007/H³ (-4q² + 6q - 2)^¼ for ½ < q ≤ 1, 0 elsewhere: a ring of attraction around where fluid rests. Bodies
/// that float are pulled as much as they pull. Used by one thread.
///
/// β is chosen such that taking a lattice of fluid off a flat wall, whose lowest layer lies one spacing above it, takes
/// the work 2a per area, a being what the scene asks for, N/m. Two halves of a fluid of tension σ take 2σ. By Young's
/// equation 2a = σ (1 + cos θ): fluid of the same tension wets the wall, of twice the tension meets it at a right
/// angle. The force on a volume of fluid is the same for every rest density.
class Adhesion {
 public:
  explicit Adhesion(const Discretisation& discretisation);

  /// Changes the velocities of particles, and of floating bodies, by a step of adhesion. `ofContainer` is that of the
  /// container and of planes, N/m; bodies have their own.
  void apply(double ofContainer, const Bodies& bodies, StepContext& step) const;

 private:
  void attractToStanding(double ofContainer, const Bodies& bodies, StepContext& step) const;
  void attractToMoving(StepContext& step) const;

  /// Acceleration, times the rest density, of a particle by a boundary particle of its own volume at
  /// (-4q² + 6q - 2)^¼ = 1, for an adhesion of 1 N/m.
  double forcePerAdhesion_;
};

}  // namespace sluice::sim
