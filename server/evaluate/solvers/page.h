#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sluice/evaluate/report.h"

namespace sluice::evaluate {

/// Case and norm of each plot: the first norm of every case.
std::vector<std::pair<std::string, std::string>> plotsOf(const std::vector<Row>& rows);

std::string solverPlotName(const std::string& caseName);

/// Error against wall time of every run, a colour for each solver, with the Pareto front.
std::string solverPlot(const std::vector<Row>& rows, const std::string& caseName, const std::string& norm,
                       const std::string& machine);

/// The page that shows all of it.
std::string solversPage(const std::vector<Row>& rows, const std::vector<Row>& orders, const std::string& machine,
                        bool quick);

}  // namespace sluice::evaluate
