#pragma once

#include "step_context.h"

namespace sluice::sim {

/// A step in which a particle would cross more than this many spacings is taken back: it could jump through the one
/// layer of boundary particles. The CFL number may be up to 1.
inline constexpr double kLargestMove = 1.5;

/// The largest speed of all particles, m/s. Sets the step's trouble where velocities are not finite or too large for
/// the step's length.
double checkedMaxSpeed(StepContext& step);

}  // namespace sluice::sim
