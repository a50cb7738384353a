// What acts on every particle of a FluidSimulation alike: gravity, and the force field of an experiment.

#include <algorithm>
#include <cmath>

#include "fluid_simulation.h"

namespace sluice::sim {

namespace {

struct Largest {
  double value = 0;
  Largest& operator+=(const Largest& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

double norm(const v1::Vec3& v) { return std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()); }

}  // namespace

Eigen::Vector3d FluidSimulation::fieldAt(const Float4& x) const {
  const auto& origin = container_.origin;
  return options_.experiment->acceleration({origin[0] + x.x, origin[1] + x.y, origin[2] + x.z}, time_);
}

double FluidSimulation::largestAcceleration() const {
  const v1::Vec3& g = settings_.gravity();
  if (!hasForceField()) return norm(g);
  const auto largest = team_.sumOverChunks<Largest>(state_.size(), [&](const Chunk& chunk) {
    Largest part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Eigen::Vector3d all = fieldAt(state_.position[i]) + Eigen::Vector3d(g.x(), g.y(), g.z());
      part.value = std::max(part.value, all.norm());
    }
    return part;
  });
  return largest.value;
}

void FluidSimulation::applyField(const StepContext& step) {
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Eigen::Vector3f dv = (fieldAt(state_.position[i]) * step.seconds).cast<float>();
      Float4& v = state_.velocity[i];
      v = {v.x + dv.x(), v.y + dv.y(), v.z + dv.z(), 0};
    }
  });
}

void FluidSimulation::applyGravity(const StepContext& step) {
  if (hasForceField()) applyField(step);
  const v1::Vec3& g = settings_.gravity();
  movingBodies_.accelerate(step.seconds * Eigen::Vector3d(g.x(), g.y(), g.z()));
  const auto change = [&](double along) { return static_cast<float>(along * step.seconds); };
  const Float4 dv{change(g.x()), change(g.y()), change(g.z()), 0};
  team_.forEachChunk(state_.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      Float4& v = state_.velocity[i];
      v = {v.x + dv.x, v.y + dv.y, v.z + dv.z, 0};
    }
  });
}

}  // namespace sluice::sim
