// The state of FluidSimulation as a file holds it.

#include <algorithm>
#include <string_view>

#include "fluid_simulation.h"

namespace sluice::sim {

namespace {

/// Name of the part of a saved state.
constexpr std::string_view kPart = "fluid simulation";

void write(core::StateWriter& out, const core::StepStatistics& statistics) {
  out.write(statistics.steps);
  out.write(statistics.timeStepSeconds);
  out.write(std::string_view(statistics.timeStepLimit));
  out.write(statistics.densityIterations);
  out.write(statistics.divergenceIterations);
  out.write(statistics.viscosityIterations);
  out.write(statistics.meanDensityError);
  out.write(statistics.maxDensityError);
  out.write(statistics.maxSpeed);
}

/// Without the stages, whose milliseconds are no part of a state.
void read(core::StateReader& in, core::StepStatistics& statistics) {
  statistics = {};
  in.read(statistics.steps);
  in.read(statistics.timeStepSeconds);
  in.read(statistics.timeStepLimit);
  in.read(statistics.densityIterations);
  in.read(statistics.divergenceIterations);
  in.read(statistics.viscosityIterations);
  in.read(statistics.meanDensityError);
  in.read(statistics.maxDensityError);
  in.read(statistics.maxSpeed);
}

}  // namespace

void FluidSimulation::save(core::StateWriter& out) const {
  out.write(kPart);
  out.write(added_);
  state_.forEachArray(state_, [&](const auto& values, const auto&) { out.write(values); });
  // Not where the particles are but where they were when they were sorted: the position-based solver has moved them on.
  out.write(grid_.cellOfSorted());
  if (population_.changes() || added_ > 0) population_.save(out);
  touch_.save(out);
  freeFlight_.save(out);
  if (!movingBodies_.empty()) movingBodies_.save(out);
  out.write(time_);
  out.write(lastStepSeconds_);
  out.write(recoverySeconds_);
  out.write(maxSpeed_);
  out.write(pressureAcceleration_);
  out.write(wallContacts_);
  out.write(std::string_view(halted_));
  write(out, statistics_);
}

void FluidSimulation::resume(core::StateReader& in) {
  in.expect(kPart);
  readParticles(in);
  if (population_.changes() || added_ > 0) population_.resume(in, state_.id);
  touch_.resume(in);
  freeFlight_.resume(in);
  if (!movingBodies_.empty()) movingBodies_.resume(in);
  in.read(time_);
  in.read(lastStepSeconds_);
  in.read(recoverySeconds_);
  in.read(maxSpeed_);
  in.read(pressureAcceleration_);
  in.read(wallContacts_);
  in.read(halted_);
  momentum_.reset();
  momentumDrift_.setZero();
  core::StepStatistics statistics;
  read(in, statistics);
  rebuildPairs();
  statistics_ = statistics;
}

void FluidSimulation::readParticles(core::StateReader& in) {
  std::uint64_t added = 0;
  in.read(added);
  ParticleState saved;
  saved.forEachArray(saved, [&](auto& values, const auto&) { in.read(values); });
  const std::uint64_t initial = state_.size() - (population_.changes() ? 0 : added_);
  added_ = added;
  const ParticleState own = newParticle();
  bool fits = true;
  saved.forEachArray(own, [&](const auto& values, const auto& one) {
    fits = fits && values.size() == (one.empty() ? 0 : saved.size());
  });
  // Only emitters, drains and hands change how many there are.
  fits = fits && (population_.changes() || saved.size() == initial + added_);
  const std::size_t fluids = mixture_.restDensities().size();
  fits = fits && std::ranges::all_of(saved.fluid, [&](std::uint8_t fluid) { return fluid < fluids; });
  std::vector<std::uint32_t> cells;
  in.read(cells);
  if (!fits || cells.size() != saved.size() || !grid_.restore(cells)) {
    in.fail("the particles are not those of the state's scene");
  }
  state_ = std::move(saved);
  previous_ = state_;
}

void FluidSimulation::rebuildPairs() {
  StepContext last = beginStep();
  last.boundaryInReach = true;
  lists_.find(grid_, state_.position, team_);
  const StepTraits present{.particles = state_.size(), .emitting = population_.emitting(time_)};
  for (const Stage stage : planStep(settings_, present).stages) {
    if (stage == Stage::Boundary || stage == Stage::Factors) run(stage, last);
    if (stage == Stage::Boundary) updateMovingBoundary(last);
  }
}

}  // namespace sluice::sim
