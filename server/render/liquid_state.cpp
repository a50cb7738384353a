#include "liquid_state.h"

#include <algorithm>

#include "sluice/render/frame_plan.h"

namespace sluice::render {

namespace {

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from, std::size_t i) {
  if (!from.empty()) to.push_back(from[i]);
}

}  // namespace

std::vector<std::shared_ptr<const core::ParticleSnapshot>> splitByFluid(const core::ParticleSnapshot& particles) {
  // Not owned: the caller's snapshot outlives the frame.
  const std::shared_ptr<const core::ParticleSnapshot> all(std::shared_ptr<void>(), &particles);
  if (particles.fluids.empty()) return {all};
  const std::size_t count = std::min<std::size_t>(kMostLiquids, 1U + std::ranges::max(particles.fluids));
  if (count == 1) return {all};

  std::vector<std::shared_ptr<core::ParticleSnapshot>> parts;
  for (std::size_t k = 0; k < count; ++k) {
    auto part = std::make_shared<core::ParticleSnapshot>();
    part->sequence = particles.sequence;
    part->time = particles.time;
    part->spacing = particles.spacing;
    part->restDensity = k < particles.restDensities.size() ? particles.restDensities[k] : particles.restDensity;
    part->supportRadius = particles.supportRadius;
    parts.push_back(std::move(part));
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    core::ParticleSnapshot& part = *parts[std::min<std::size_t>(particles.fluids[i], count - 1)];
    part.positions.push_back(particles.positions[i]);
    append(part.velocities, particles.velocities, i);
    append(part.densities, particles.densities, i);
    append(part.ids, particles.ids, i);
    append(part.pressures, particles.pressures, i);
    append(part.ages, particles.ages, i);
    append(part.neighbours, particles.neighbours, i);
  }
  for (const auto& part : parts) part->bounds = core::boundsOf(part->positions);
  return {parts.begin(), parts.end()};
}

}  // namespace sluice::render
