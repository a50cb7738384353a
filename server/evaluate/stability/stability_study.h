#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// Cases that are made to break what they test. Rows of smoothing have case, method, strength, outcome, largest, limit,
/// passed; of solvers see toRow in solver_outcome.h and stepLimits.
std::vector<std::string> stabilityParts();
Report runStabilityStudy(const Options& options);

}  // namespace sluice::evaluate
