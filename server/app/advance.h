#pragma once

#include <cstdint>
#include <memory>

#include "sluice/core/particle_source.h"

namespace sluice::app {

/// Steps to the first state at or after `time`, s. Throws core::EnvironmentError where the source halts before.
void advanceTo(core::ParticleSource& source, double time);

/// The present state under a number of its own, by which the renderer knows particles that it has seen.
std::unique_ptr<core::ParticleSnapshot> takeSnapshot(const core::ParticleSource& source, std::uint64_t sequence);

}  // namespace sluice::app
