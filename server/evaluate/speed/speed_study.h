#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// The speed of the solver: over the number of particles, over threads, and of each stage against what the machine can
/// do. Columns: part, particles, threads, steps, milliseconds_per_step, nanoseconds_per_particle, density_iterations,
/// bytes_per_particle, mean_density_error, max_density_error.
std::vector<std::string> speedParts();
Report runSpeedStudy(const Options& options);

}  // namespace sluice::evaluate
