#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// What leaving out saves: each gate of the renderer measured with its feature in use and left out, frame by frame in
/// turn. Columns: feature, in_use, left_out, passes (those that only the first runs), milliseconds_in_use,
/// milliseconds_left_out, ratio, milliseconds_saved, bytes_in_use, bytes_left_out, bytes_saved.
std::vector<std::string> featureParts();
Report runFeaturesStudy(const Options& options);

}  // namespace sluice::evaluate
