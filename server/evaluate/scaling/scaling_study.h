#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// How the time of a frame grows with particles and with pixels. Columns of the fits: axis, stage, exponent,
/// exponent_standard_error, fixed_milliseconds, smallest, largest.
std::vector<std::string> scalingParts();
Report runScalingStudy(const Options& options);

}  // namespace sluice::evaluate
