#pragma once

#include <string>

#include "scenes.h"
#include "sluice/core/interaction.h"

namespace sluice::sim {

/// A touch along the ray from `origin`, m, in `direction`, of any length; the rest of it as viewers have it by default.
core::Interaction touchOf(core::Interaction::Action action, const Eigen::Vector3d& origin,
                          const Eigen::Vector3d& direction);

/// Straight down into the middle of smallDamBreak's block.
core::Interaction downInto(core::Interaction::Action action);

/// Why the touch is refused, which must leave the state as it was. A failure of the test, and empty, where it is done.
std::string refusal(FluidSimulation& simulation, const core::Interaction& interaction);

}  // namespace sluice::sim
