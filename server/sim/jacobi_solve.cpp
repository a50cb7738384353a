#include "jacobi_solve.h"

#include "body_contacts.h"

namespace sluice::sim {

SolveOutcome JacobiSolve::run(const SolveGoal& goal, const NeighbourLists& lists, const Mobility& mobility,
                              const std::vector<float>& ownFactor, std::vector<Float4>& velocity,
                              std::vector<float>& impulse, const Team& team) {
  const std::size_t particles = velocity.size();
  const PairLoops& loops = lists.loops();
  if (goal.bodies != nullptr) goal.bodies->begin(ownFactor, goal.density, goal.seconds, team);
  const std::vector<float>& factor = goal.bodies != nullptr ? goal.bodies->factor() : ownFactor;
  const float* density = goal.density != nullptr ? goal.density->data() : nullptr;
  if (goal.bodies != nullptr) density = goal.bodies->density().data();
  impulse4_.resize(particles);
  result_.resize(particles);

  team.forEachChunk(particles, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const float start = factor[i] > 0 ? impulse[i] : 0;
      impulse4_[i] = {start, start, start, start};
    }
  });

  SolveOutcome outcome;
  while (outcome.iterations < goal.maxIterations) {
    ++outcome.iterations;
    team.forEachChunk(particles, [&](const Chunk& chunk) {
      loops.applyImpulses(lists.chunk(chunk), mobility, impulse4_.data(), lists.gradientSum().data(), velocity.data(),
                          result_.data());
    });
    if (goal.bodies != nullptr) goal.bodies->respond(impulse4_, team);
    const auto error = team.sumOverChunks<SolveError>(particles, [&](const Chunk& chunk) {
      return loops.relaxImpulses(lists.chunk(chunk), result_.data(), lists.gradientSum().data(), factor.data(), density,
                                 static_cast<float>(goal.seconds), static_cast<float>(goal.relaxation),
                                 impulse4_.data());
    });
    outcome.meanError = error.sum / static_cast<double>(particles);
    outcome.maxError = static_cast<double>(error.largest);
    if (outcome.iterations >= goal.minIterations && outcome.meanError <= goal.tolerance) break;
  }

  team.forEachChunk(particles, [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) impulse[i] = impulse4_[i].x;
  });
  velocity.swap(result_);
  return outcome;
}

}  // namespace sluice::sim
