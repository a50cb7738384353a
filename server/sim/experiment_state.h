#pragma once

#include "container.h"
#include "particles.h"
#include "sluice/sim/experiment.h"

namespace sluice::sim {

/// The particles of an experiment. Throws core::InputError where they are not finite or not inside of the container.
ParticleState stateOf(const Experiment& experiment, const Container& container);

/// Throws core::InputError where a periodic container is too short for the search for neighbours.
void checkPeriod(const Container& container, double support);

}  // namespace sluice::sim
