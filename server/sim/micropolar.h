#pragma once

#include <vector>

#include "sluice/v1/scene.pb.h"
#include "step_context.h"

namespace sluice::sim {

/// A micropolar fluid [BKKW17: Bender et al. 2017, A micropolar material model for turbulent SPH fluids], whose
/// particles spin: Dv/Dt = … + ν_t ∇×ω, Θ Dω/Dt = ν_t (∇×v - 2 ω), and spins even out between neighbours. It feeds
/// eddies that the particles are too coarse for.
///
/// ∇×v is the difference form of the paper, exact for rigid rotation; ∇×ω is its adjoint, the sum form, where the paper
/// takes the difference form too: this keeps momentum. The decay -2 ω is implicit. As in the paper, the exchange gives
/// more than it takes where the fluid's own viscosity is below ν_t/2.
class MicropolarModel {
 public:
  /// Makes particles carry a spin, 0.
  static void reset(ParticleState& state) { state.spin.assign(state.size(), {}); }

  /// Changes velocities and spins by a step.
  void apply(const v1::Micropolar& settings, StepContext& step);

  std::uint64_t bytes() const { return (velocity_.size() + spin_.size()) * sizeof(Float4); }

 private:
  std::vector<Float4> velocity_;
  std::vector<Float4> spin_;
};

}  // namespace sluice::sim
