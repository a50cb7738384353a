#pragma once

#include <vector>

#include "stability/stability_job.h"

namespace sluice::evaluate {

/// Particles that no scene should have, with every solver: none, one, coincident ones, ones that are not finite,
/// outside of the container, in a wall, at 10⁶ m/s; fluids a thousand times as heavy as others. Each has to be refused
/// or stopped with a message, or come out finite.
std::vector<StabilityJob> particleJobs(int threads);

}  // namespace sluice::evaluate
