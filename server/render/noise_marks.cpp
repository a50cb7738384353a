#include "noise_marks.h"

#include <bit>
#include <cmath>
#include <limits>

namespace sluice::render {

namespace {

constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

}  // namespace

IdIndex::IdIndex(std::span<const std::uint32_t> ids) : ids_(ids), slots_(std::bit_ceil(2 * ids.size() + 1), kEmpty) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::size_t slot = slotOf(ids[i]);
    if (slots_[slot] == kEmpty) slots_[slot] = static_cast<std::uint32_t>(i);
  }
}

/// Where the id is, or the first empty slot after where it would be.
std::size_t IdIndex::slotOf(std::uint32_t id) const {
  // Ids are mostly counted through: they fill one slot after another, next to each other in memory too.
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = id & mask;
  while (slots_[slot] != kEmpty && ids_[slots_[slot]] != id) slot = (slot + 1) & mask;
  return slot;
}

std::size_t IdIndex::find(std::uint32_t id) const {
  const std::uint32_t found = slots_[slotOf(id)];
  return found == kEmpty ? kNone : found;
}

void NoiseMarks::follow(const core::ParticleSnapshot& particles, const v1::Noise& noise) {
  if (!canFollow(particles)) {
    *this = {};
    return;
  }
  std::vector<float> violence(particles.size(), 0.0F);
  const double elapsed = particles.time - time_;
  // Time that goes back is another run; that it has not moved is the same moment, in which nobody accelerates.
  if (elapsed >= 0 && !ids_.empty()) {
    const float kept = static_cast<float>(std::exp(-elapsed / noise.cool_down_seconds()));
    const double most = noise.acceleration_threshold() * elapsed;
    const IdIndex former(ids_);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const std::size_t before = former.find(particles.ids[i]);
      if (before == IdIndex::kNone) continue;
      const double change = (particles.velocities[i] - velocities_[before]).norm();
      violence[i] = elapsed > 0 && change > most ? 1.0F : violence_[before] * kept;
    }
  }
  time_ = particles.time;
  ids_ = particles.ids;
  velocities_ = particles.velocities;
  violence_ = std::move(violence);
}

}  // namespace sluice::render
