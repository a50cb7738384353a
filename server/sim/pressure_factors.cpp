#include "pressure_factors.h"

namespace sluice::sim {

void computePressureFactors(const StepContext& step, std::vector<float>& factor) {
  const NeighbourLists& lists = step.lists;
  const std::size_t particles = step.state.size();
  factor.resize(particles);
  // Below this share of 1/H² there is no neighbour to push against.
  const float least = 1e-6F / static_cast<float>(step.discretisation.support * step.discretisation.support);
  const Mobility mobility = step.mixture.mobility(step.state.fluid);
  step.team.forEachChunk(particles, [&](const Chunk& chunk) {
    if (mobility.fluid != nullptr) lists.loops().weighSquares(lists.chunk(chunk), mobility, factor.data());
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& d = lists.gradientSum()[i];
      const float own = d.x * d.x + d.y * d.y + d.z * d.z;
      const float denominator = mobility.fluid == nullptr ? own + lists.gradientSquares()[i]  // 1/α_i [BK17]
                                                          : mobility.ofFluid[step.state.fluid[i]] * own + factor[i];
      factor[i] = denominator > least ? 1 / denominator : 0;
    }
  });
}

}  // namespace sluice::sim
