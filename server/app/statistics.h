#pragma once

#include <vector>

#include "sluice/core/stage_times.h"

namespace sluice::app {

/// The middle value (the mean of the middle two); 0 for none.
double median(std::vector<double> values);

/// Stage by stage over several runs, in the order of the first that has the stage; a run without it counts as 0 ms.
core::StageTimes medianStageTimes(const std::vector<core::StageTimes>& runs);

/// Sums each stage over several runs and divides by their number.
core::StageTimes meanStageTimes(const core::StageTimes& sums, std::size_t runs);

}  // namespace sluice::app
