// Which boundaries FluidSimulation has to look at in a step.

#include "fluid_simulation.h"
#include "move_check.h"

namespace sluice::sim {

namespace {

/// Whether a particle is nearer to a face of the container than `reach`.
bool nearFaces(const Container& container, const Float4& x, double reach) {
  if (container.enclosure) return container.enclosure->distance({x.x, x.y, x.z}) < reach;
  const auto near = [&](double position, double size) { return position < reach || position > size - reach; };
  const auto& size = container.size;
  return near(x.x, size[0]) || near(x.y, size[1]) || (!container.plane && near(x.z, size[2]));
}

struct Count {
  std::uint64_t value = 0;
  Count& operator+=(const Count& other) {
    value += other.value;
    return *this;
  }
};

}  // namespace

void FluidSimulation::updateMovingBoundary(StepContext& step) {
  if (step.bodies == nullptr) return;
  movingBoundary_.update(movingBodies_, boundary_, team_);
  step.findContacts();
}

void FluidSimulation::findBoundaryInReach() {
  if (container_.periodic) {
    boundaryInReach_ = false;
    return;
  }
  const double reach = discretisation_.support + kLargestMove * discretisation_.spacing;
  const auto near = team_.sumOverChunks<Count>(state_.size(), [&](const Chunk& chunk) {
    Count part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& x = state_.position[i];
      const bool nearContainer = nearFaces(container_, x, reach);
      part.value += nearContainer || walls_.nearBodies(x) != 0 ? 1 : 0;
    }
    return part;
  });
  // New particles may come near a wall in the step in which they come.
  boundaryInReach_ = near.value > 0 || population_.emitting(time_);
  if (movingBodies_.empty()) return;
  // Bodies come towards particles as far as these towards them.
  const double bodyReach = reach + kLargestMove * discretisation_.spacing;
  const auto nearMoving = team_.sumOverChunks<Count>(state_.size(), [&](const Chunk& chunk) {
    Count part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& x = state_.position[i];
      part.value += movingBodies_.near({x.x, x.y, x.z}, bodyReach) ? 1 : 0;
    }
    return part;
  });
  bodiesInReach_ = nearMoving.value > 0;
}

}  // namespace sluice::sim
