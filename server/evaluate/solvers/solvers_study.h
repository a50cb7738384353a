#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/study.h"
#include "solvers/run.h"

namespace sluice::evaluate {

/// Every pressure solver on flows whose course is known, by resolution and tolerance or step. Columns: case, solver,
/// spacing, particles, tolerance, time_step, steps, iterations, wall_seconds, error, error_norm, reference.
std::vector<std::string> solverParts();
Report runSolversStudy(const Options& options);

/// One row for each finding of a run.
std::vector<Row> rowsOf(const Case& solverCase, const Run& run, const std::vector<Finding>& findings);

/// Observed orders of convergence, from the coarsest to the finest resolution of each case, solver, setting and norm.
/// Columns: case, solver, tolerance, error_norm, coarsest, finest, order.
std::vector<Row> convergenceOrders(const std::vector<Row>& rows);

}  // namespace sluice::evaluate
