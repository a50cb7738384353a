#include "stability/stability_study.h"

#include <algorithm>

#include "stability/particle_cases.h"
#include "stability/smoothing_stability.h"
#include "stability/step_limits.h"
#include "stability/stiffness_cases.h"

namespace sluice::evaluate {

namespace {

constexpr const char* kSmoothing = "smoothing";
constexpr const char* kParticles = "particles";
constexpr const char* kStiffness = "stiffness";
constexpr const char* kLimits = "limits";
constexpr const char* kMap = "map";

std::string describeSmoothing(const Row& row) {
  return row.text("method") + ", T = " + shortText(row.number("strength")) + " d², " + row.text("case") + ": " +
         row.text("outcome") + " (" + shortText(row.number("largest")) + " of " + shortText(row.number("limit")) + ")";
}

std::string describeSolver(const Row& row) {
  return row.text("solver") + ", " + row.text("case") + ": " + row.text("outcome");
}

/// A section of the page on rows that are there.
template <class Describe>
void report(Report& all, std::string& page, const std::string& heading, Table table,
            const std::vector<std::pair<std::string, std::string>>& columns, Describe describe) {
  if (table.rows.empty()) return;
  std::size_t failed = 0;
  for (const Row& row : table.rows) {
    if (row.flag("passed")) continue;
    all.failures.push_back(describe(row));
    ++failed;
  }
  page += "\n## " + heading + "\n\n" + std::to_string(table.rows.size()) + " cases, " + std::to_string(failed) +
          " failed.\n\n" + toMarkdown(table.rows, columns);
  all.tables.push_back(std::move(table));
}

}  // namespace

std::vector<std::string> stabilityParts() { return {kSmoothing, kParticles, kStiffness, kLimits, kMap}; }

Report runStabilityStudy(const Options& options) {
  const auto wants = [&](const char* part) { return options.only.empty() || options.only == part; };
  Report all;
  std::string page = "# Stability\n";
  if (wants(kSmoothing)) {
    report(all, page, "Smoothing", {"stability", smoothingStability(options)},
           {{"case", "case"},
            {"method", "method"},
            {"strength", "T d²"},
            {"outcome", "outcome"},
            {"largest", "largest"},
            {"limit", "limit"},
            {"passed", "passed"}},
           describeSmoothing);
  }
  std::vector<Row> rows;
  if (wants(kParticles)) std::ranges::move(particleStability(options), std::back_inserter(rows));
  if (wants(kStiffness)) std::ranges::move(stiffnessStability(options), std::back_inserter(rows));
  if (wants(kMap)) std::ranges::move(stabilityMaps(options, rows), std::back_inserter(all.documents));
  report(all, page, "Solvers", {"stability_solvers", std::move(rows)},
         {{"case", "case"},
          {"solver", "solver"},
          {"outcome", "outcome"},
          {"fastest", "fastest m/s"},
          {"compression", "compression"},
          {"iterations_per_step", "iterations a step"},
          {"shortest_step", "shortest step s"},
          {"passed", "passed"}},
         describeSolver);
  if (wants(kLimits)) {
    report(all, page, "Longest steps", {"stability_limits", stepLimits(options)},
           {{"case", "case"},
            {"solver", "solver"},
            {"measured", "measured"},
            {"used", "used"},
            {"published", "published"},
            {"linear_theory", "linear theory"},
            {"unit", "in units of"},
            {"outcome", "outcome"},
            {"passed", "passed"}},
           describeSolver);
  }
  for (const Document& map : all.documents) page += "\n![" + map.fileName + "](" + map.fileName + ")\n";
  all.documents.push_back({"stability.md", std::move(page)});
  return all;
}

}  // namespace sluice::evaluate
