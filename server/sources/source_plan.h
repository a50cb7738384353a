#pragma once

#include "sluice/core/plan.h"
#include "sluice/particleio/particle_file.h"

namespace sluice::sources {

/// What every source of stored particles has in common: its arrays, and the solver that it does without.
core::Plan planOfStored(const particleio::ParticleFileData& particles);

}  // namespace sluice::sources
