#pragma once

#include <vector>

#include "stability/stability_job.h"

namespace sluice::evaluate {

/// What makes a step hard, with every solver: deep columns, cold and (DFSPH) warm; sound ten times as fast; viscosity
/// up to 10⁴ d² a step; a step ten times as long as the last; steps of up to ten times what tension allows; a fall from
/// 100 m.
std::vector<StabilityJob> stiffnessJobs(bool quick, int threads);

/// A column of water at rest, ten particles of 0.02 m wide, or six from 100 layers on.
Trial column(int layers);

}  // namespace sluice::evaluate
