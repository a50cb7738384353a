#pragma once

#include <vector>

#include "sluice/evaluate/report.h"
#include "sluice/evaluate/study.h"

namespace sluice::evaluate {

/// What makes a step hard: deep columns from a cold start, sound ten times as fast, viscosity up to 10⁴ h² a step, a
/// step ten times as long as the last, a fall from 100 m, and pressures below 0 that most solvers clamp.
std::vector<Row> stiffnessStability(const Options& options);

/// Columns of rising height in steps of rising length: which solver bears what. A plot for each solver.
std::vector<Document> stabilityMaps(const Options& options, std::vector<Row>& rows);

}  // namespace sluice::evaluate
