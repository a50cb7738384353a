#pragma once

#include <vector>

#include "stability/stability_job.h"

namespace sluice::evaluate {

/// Floating bodies with every solver: a thousand times as heavy and as light as the water, and two of which one is a
/// thousand times as heavy as the other, side by side and stacked either way round.
std::vector<StabilityJob> bodyJobs(int threads);

}  // namespace sluice::evaluate
