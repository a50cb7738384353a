#include "viscosity_explicit.h"

namespace sluice::sim {

void ExplicitViscosity::apply(StepContext& step) {
  // As ∇W_ij is parallel to x_ij, (v_ij·x_ij) ∇W_ij = (v_ij·∇W_ij) x_ij, which is what the loop sums.
  const PairStrength friction =
      step.mixture.friction(step.state.fluid, step.discretisation.viscosityScale * step.seconds);
  result_.resize(step.state.size());
  step.team.forEachChunk(step.state.size(), [&](const Chunk& chunk) {
    step.lists.loops().applyViscosity(step.lists.chunk(chunk), step.lists.scale(), friction, step.state.position.data(),
                                      step.state.velocity.data(), result_.data());
  });
  step.state.velocity.swap(result_);
}

}  // namespace sluice::sim
