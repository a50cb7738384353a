#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// Every smoothing method against surfaces that are known: error, time, flicker; and the tables of the paper.
std::vector<std::string> smoothingParts();
Report runSmoothingStudy(const Options& options);

}  // namespace sluice::evaluate
