#pragma once

#include <vector>

#include "stability/stability_job.h"

namespace sluice::evaluate {

/// The longest steps that explicit terms are stable in, found by halving intervals, beside the bounds that are used for
/// them. Columns: case, solver, unit (of time, of all that follow), measured, used (by the simulation itself),
/// published, linear_theory, outcome, passed.
std::vector<StabilityJob> limitJobs(int threads);

/// The longest stable step of weakly compressible SPH on a square lattice of the cubic spline of two spacings, in units
/// of h/c0: 2/ω of the lattice's fastest wave, for symplectic Euler.
double latticeAcousticLimit();

}  // namespace sluice::evaluate
