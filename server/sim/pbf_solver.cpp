#include "pbf_solver.h"

#include <algorithm>
#include <sstream>

#include "move_check.h"
#include "pressure_factors.h"
#include "sluice/core/check.h"

namespace sluice::sim {

void PbfSolver::run(Stage stage, StepContext& step) {
  SLUICE_CHECK(stage == Stage::PositionSolve);
  if (step.state.size() == 0) return;  // All have just gone down a drain.
  step.state.densityImpulse.assign(step.state.size(), 0);
  for (std::uint32_t iteration = 0; iteration < settings_.iterations(); ++iteration) {
    correct(step);
    step.maxSpeed = checkedMaxSpeed(step);
    if (!step.trouble.empty()) return;
    // The particles stay sorted by where the step took them: a correction is small against a cell, and a pair that it
    // brings into reach from beyond the next cell weighs nothing yet.
    step.lists.find(step.grid, step.state.position, step.team);
    if (step.boundaryInReach) {
      step.lists.addBoundary(step.boundary, wallAnswer(), step.grid, step.state.position, step.team);
    }
    step.findContacts();
  }
  step.statistics.densityIterations = settings_.iterations();
  const float densest = *std::ranges::max_element(step.lists.density());
  if (densest - 1 > step.maxCompression) {
    std::ostringstream text;
    text << "the position solve left a particle compressed by " << 100 * (densest - 1) << " %, more than "
         << "simulation.time_step.max_compression";
    step.trouble = text.str();
  }
}

void PbfSolver::correct(StepContext& step) {
  ParticleState& state = step.state;
  const NeighbourLists& lists = step.lists;
  computePressureFactors(step, factor_);
  impulse4_.resize(state.size());
  corrected_.resize(state.size());
  const auto seconds = static_cast<float>(step.seconds);
  const float share = static_cast<float>(settings_.relaxation() * step.discretisation.relaxationScale) / seconds;
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const float constraint = std::max(lists.density()[i] - 1.0F, 0.0F);
      const float k = share * constraint * factor_[i];
      impulse4_[i] = {k, k, k, k};
      state.densityImpulse[i] += k;
    }
  });
  // As velocities, in which a correction keeps more digits than in positions, and momentum is kept.
  const Mobility mobility = step.mixture.mobility(state.fluid);
  step.team.forEachChunk(state.size(), [&](const Chunk& chunk) {
    lists.loops().applyImpulses(lists.chunk(chunk), mobility, impulse4_.data(), lists.gradientSum().data(),
                                state.velocity.data(), corrected_.data());
  });
  if (BodyCoupling* bodies = step.coupling()) bodies->push(impulse4_, 1, step.team);
  const auto massOf = [&](std::size_t i) {
    return step.discretisation.volume * step.mixture.restDensityOf(state.fluid, i);
  };
  const auto pushed = step.team.sumOverChunks<BodySums>(state.size(), [&](const Chunk& chunk) {
    BodyPush push;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      if (step.bodies != nullptr) push.particleMass = massOf(i);
      Float4& x = state.position[i];
      Float4& v = corrected_[i];
      const Float4& before = state.velocity[i];
      step.walls.move(
          x, v,
          {x.x + seconds * (v.x - before.x), x.y + seconds * (v.y - before.y), x.z + seconds * (v.z - before.z), 0},
          push);
    }
    return push.momenta;
  });
  if (step.bodies != nullptr) step.bodies->bodies.push(pushed);
  state.velocity.swap(corrected_);
}

std::uint64_t PbfSolver::bytes() const {
  return factor_.size() * sizeof(float) + (impulse4_.size() + corrected_.size()) * sizeof(Float4);
}

}  // namespace sluice::sim
