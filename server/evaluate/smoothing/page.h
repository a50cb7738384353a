#pragma once

#include <string>
#include <vector>

#include "sluice/evaluate/report.h"

namespace sluice::evaluate {

/// A plot of one error of one shape against the time of smoothing, one series per method and resolution, with the
/// Pareto front. `row`s are of `smoothingRows`.
std::string smoothingPlot(const std::vector<Row>& rows, const std::string& shape, const std::string& errorKey,
                          const std::string& errorLabel, const std::string& machine);

/// The study as a page in Markdown, with its plots as pictures.
std::string smoothingPage(const std::vector<Row>& rows, const std::vector<Row>& paperRows,
                          const std::vector<std::string>& notes, const std::string& machine, bool quick);

/// The shapes of the rows, in order.
std::vector<std::string> shapesOf(const std::vector<Row>& rows);

std::string normalPlotName(const std::string& shape);
std::string depthPlotName(const std::string& shape);

}  // namespace sluice::evaluate
