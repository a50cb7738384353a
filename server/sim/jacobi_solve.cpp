#include "jacobi_solve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "body_contacts.h"

namespace sluice::sim {

namespace {

/// Relaxation ω of an extrapolated step over that of a plain one. Plain steps converge for ω below 2/λ, λ being the
/// largest eigenvalue of the system over its diagonal, those with momentum β for ω below 2/λ times this.
double shareWithMomentum(double momentum) { return (1 + momentum) / (1 + 2 * momentum); }

/// What a chunk contributes to an iteration's outcome.
struct Progress {
  SolveError error;
  double turning = 0;  ///< > 0 where the iteration runs past the solution.

  Progress& operator+=(const Progress& other) {
    error += other.error;
    turning += other.turning;
    return *this;
  }
};

void setAll(Float4& lanes, float value) { lanes = {value, value, value, value}; }

}  // namespace

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
      if (!(factor[i] > 0)) impulse[i] = 0;
      setAll(impulse4_[i], impulse[i]);
    }
  });

  /// One step from κ, in impulse4_, which it leaves extrapolated by `momentum` times the way from the last iterate.
  const auto relax = [&](const Chunk& chunk, float relaxation, float momentum) {
    std::array<float, kChunk> before;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) before[i - chunk.first] = impulse4_[i].x;
    Progress part;
    part.error = loops.relaxImpulses(lists.chunk(chunk), result_.data(), lists.gradientSum().data(), factor.data(),
                                     density, static_cast<float>(goal.seconds), relaxation, impulse4_.data());
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      if (!(factor[i] > 0)) continue;
      const float next = impulse4_[i].x;
      const float change = next - before[i - chunk.first];
      const float gain = next - impulse[i];
      part.turning -= static_cast<double>(change * gain / factor[i]);
      impulse[i] = next;
      setAll(impulse4_[i], std::max(next + momentum * gain, 0.0F));
    }
    return part;
  };

  SolveOutcome outcome;
  double t = 1;
  while (outcome.iterations < goal.maxIterations) {
    ++outcome.iterations;
    team.forEachChunk(particles, [&](const Chunk& chunk) {
      loops.applyImpulses(lists.chunk(chunk), mobility, impulse4_.data(), lists.gradientSum().data(), velocity.data(),
                          result_.data());
      for (const WallContact& contact : lists.wallContacts(chunk)) {
        const std::uint32_t i = contact.particle;
        const Float4& before = velocity[i];
        Float4& after = result_[i];
        const Float4 more = contact.surplus({after.x - before.x, after.y - before.y, after.z - before.z, 0});
        after = {after.x + more.x, after.y + more.y, after.z + more.z, 0};
      }
    });
    if (goal.bodies != nullptr) goal.bodies->respond(impulse4_, team);
    const double nextT = (1 + std::sqrt(1 + 4 * t * t)) / 2;  // [BT09]
    // Where particles differ in mobility, a light fluid over a heavy one was seen to be stirred by extrapolation.
    const double momentum = mobility.fluid == nullptr ? (t - 1) / nextT : 0;
    const double relaxation = goal.relaxation * shareWithMomentum(momentum);
    const auto progress = team.sumOverChunks<Progress>(particles, [&](const Chunk& chunk) {
      return relax(chunk, static_cast<float>(relaxation), static_cast<float>(momentum));
    });
    t = progress.turning > 0 ? 1 : nextT;  // [OC15], with the gradient scheme.
    outcome.meanError = progress.error.sum / static_cast<double>(particles);
    outcome.maxError = static_cast<double>(progress.error.largest);
    if (outcome.iterations >= goal.minIterations && outcome.meanError <= goal.tolerance) break;
  }

  velocity.swap(result_);
  return outcome;
}

}  // namespace sluice::sim
