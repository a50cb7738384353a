#pragma once

#include <string>
#include <vector>

#include "stability/stability_job.h"

namespace sluice::evaluate {

/// Columns of rising height in steps of rising length: which solver bears what. Rows have layers and step besides.
std::vector<StabilityJob> mapJobs(bool quick, int threads);

/// The map of those rows: stiffness × step, a field for each solver. `subtitle`: what it was measured on.
std::string drawStabilityMap(const std::vector<Row>& rows, const std::string& subtitle);

}  // namespace sluice::evaluate
