#include "solvers/page.h"

#include <algorithm>
#include <cctype>

#include "scatter_plot.h"
#include "solvers/method.h"

namespace sluice::evaluate {

namespace {

using Columns = std::vector<std::pair<std::string, std::string>>;

std::vector<Row> rowsOf(const std::vector<Row>& rows, const std::string& caseName) {
  std::vector<Row> result;
  std::ranges::copy_if(rows, std::back_inserter(result), [&](const Row& row) { return row.text("case") == caseName; });
  return result;
}

std::string title(const Row& row) {
  return row.text("setting") + ", d = " + shortText(row.number("spacing")) + " m, " +
         shortText(row.number("wall_seconds")) + " s: " + shortText(row.number("error"));
}

/// Norms that are no lengths are shares of something.
std::string withUnit(const std::string& norm) { return norm.ends_with(", m") ? norm : norm + " (1 is 100 %)"; }

/// Whether a run's setting is its solver's default, less exact, or more.
PlotSeries::Fill fillOf(const Row& row) {
  // Settings come from the least exact to the most exact.
  PlotSeries::Fill fill = PlotSeries::Fill::Dot;
  for (const Method& method : solverMethods(false)) {
    if (method.solver() != row.text("solver")) continue;
    if (isDefault(method)) fill = PlotSeries::Fill::Solid;
    if (method.text() == row.text("setting")) return fill;
    if (isDefault(method)) fill = PlotSeries::Fill::Ring;
  }
  return PlotSeries::Fill::Solid;
}

/// The rows of a norm that no other of the same case beats in both time and error, by rising time.
std::vector<Row> bestRows(const std::vector<Row>& rows, const std::string& norm) {
  std::vector<PlotPoint> points;
  for (const Row& row : rows) {
    if (row.text("error_norm") == norm) points.push_back({row.number("wall_seconds"), row.number("error"), {}});
  }
  std::vector<Row> result;
  for (const PlotPoint& best : paretoFront(points)) {
    const auto found = std::ranges::find_if(rows, [&](const Row& row) {
      return row.text("error_norm") == norm && row.number("wall_seconds") == best.x && row.number("error") == best.y;
    });
    if (found != rows.end()) result.push_back(*found);
  }
  return result;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plotsOf(const std::vector<Row>& rows) {
  std::vector<std::pair<std::string, std::string>> plots;
  for (const Row& row : rows) {
    if (row.text("error_norm") == "stopped") continue;
    const bool known = std::ranges::any_of(plots, [&](const auto& plot) { return plot.first == row.text("case"); });
    if (!known) plots.emplace_back(row.text("case"), row.text("error_norm"));
  }
  return plots;
}

std::string solverPlotName(const std::string& caseName) {
  std::string name = "solvers_";
  for (const char c : caseName) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) name += c;
    if (!plain && name.back() != '_') name += '_';
  }
  return name + ".svg";
}

std::string solverPlot(const std::vector<Row>& rows, const std::string& caseName, const std::string& norm,
                       const std::string& machine) {
  ScatterPlot plot;
  plot.title = caseName + ": error against run time";
  plot.subtitle = machine + "; a line joins the resolutions of a setting";
  plot.xLabel = "run time, s";
  plot.yLabel = withUnit(norm);
  plot.paretoFront = true;
  std::vector<std::string> solvers;
  std::vector<std::string> settings;
  for (const Row& row : rowsOf(rows, caseName)) {
    if (row.text("error_norm") != norm) continue;
    auto solver = std::ranges::find(solvers, row.text("solver"));
    if (solver == solvers.end()) solver = solvers.insert(solvers.end(), row.text("solver"));
    auto setting = std::ranges::find(settings, row.text("setting"));
    if (setting == settings.end()) {
      setting = settings.insert(settings.end(), row.text("setting"));
      PlotSeries series;
      series.name = row.text("solver");
      series.colour = static_cast<int>(solver - solvers.begin());
      series.fill = fillOf(row);
      plot.series.push_back(std::move(series));
    }
    PlotSeries& series = plot.series[static_cast<std::size_t>(setting - settings.begin())];
    series.points.push_back({row.number("wall_seconds"), row.number("error"), title(row),
                             row.text("setting") + ", d = " + shortText(1e3 * row.number("spacing")) + " mm"});
  }
  const bool sweeps =
      std::ranges::any_of(plot.series, [](const PlotSeries& series) { return series.fill != PlotSeries::Fill::Solid; });
  if (sweeps) plot.fillKey = {"default setting", "more exact", "less exact"};
  return drawSvg(plot);
}

std::string solversPage(const std::vector<Row>& rows, const std::vector<Row>& orders, const std::string& machine,
                        bool quick) {
  std::string text = "# Solvers: error against run time\n\nMeasured on " + machine +
                     ", once each; the time is that of the steps alone. Tolerances are mean compressions, in %.";
  text += quick ? " A quick run: every solver at its default, two resolutions.\n" : "\n";
  const Columns columns{{"error_norm", "error"},      {"setting", "solver"},      {"spacing", "d m"},
                        {"particles", "particles"},   {"time_step", "mean dt s"}, {"steps", "steps"},
                        {"iterations", "iterations"}, {"wall_seconds", "run s"},  {"error", "is"},
                        {"reference", "against"}};
  for (const auto& [caseName, norm] : plotsOf(rows)) {
    const std::vector<Row> ofCase = rowsOf(rows, caseName);
    text += "\n## " + caseName + "\n\n![" + norm + " against run time](" + solverPlotName(caseName) + ")\n\n";
    text += "Nothing measured is both faster and closer (" + norm + ") than:\n\n";
    const Columns front{{"setting", "solver"}, {"spacing", "d m"}, {"wall_seconds", "run s"}, {"error", norm}};
    text += toMarkdown(bestRows(ofCase, norm), front);
    const std::vector<Row> ordersOfCase = rowsOf(orders, caseName);
    if (!ordersOfCase.empty()) {
      text += "\nObserved orders of convergence:\n\n";
      text += toMarkdown(ordersOfCase, {{"error_norm", "error"},
                                        {"setting", "solver"},
                                        {"coarsest", "from d m"},
                                        {"finest", "to d m"},
                                        {"order", "order"}});
    }
    text += "\nAll runs:\n\n" + toMarkdown(ofCase, columns);
  }
  return text;
}

}  // namespace sluice::evaluate
