#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// Cases that are made to break what they test. Every row has case, method, strength, outcome, largest, limit, passed.
std::vector<std::string> stabilityParts();
Report runStabilityStudy(const Options& options);

}  // namespace sluice::evaluate
