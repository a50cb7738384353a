#include "advance.h"

#include "sluice/core/input_error.h"

namespace sluice::app {

void advanceTo(core::ParticleSource& source, double time) {
  while (source.time() < time && source.advance()) {
  }
  if (!source.halted().empty()) throw core::EnvironmentError("the simulation halted: " + source.halted());
}

std::unique_ptr<core::ParticleSnapshot> takeSnapshot(const core::ParticleSource& source, std::uint64_t sequence) {
  std::unique_ptr<core::ParticleSnapshot> snapshot = source.snapshot();
  snapshot->sequence = sequence;
  return snapshot;
}

}  // namespace sluice::app
