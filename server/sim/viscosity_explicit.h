#pragma once

#include <vector>

#include "step_context.h"

namespace sluice::sim {

/// Explicit viscosity of the classical form, which keeps linear and angular momentum [Monaghan 1992]:
/// a_i = 2(D+2) Σ_j ν_ij V_j (v_ij·x_ij) / (|x_ij|² + 0.01 H²) ∇W_ij, scaled so that a lattice that is sheared has the
/// viscosity asked for (Discretisation::viscosityScale). Walls are free of friction.
class ExplicitViscosity {
 public:
  /// Changes the velocities by a step of friction.
  void apply(StepContext& step);

  std::uint64_t bytes() const { return result_.size() * sizeof(Float4); }

 private:
  std::vector<Float4> result_;
};

}  // namespace sluice::sim
