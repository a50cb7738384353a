#include "stability/stability_study.h"

#include <algorithm>

#include "machine.h"
#include "progress.h"
#include "solvers/run_store.h"
#include "stability/body_cases.h"
#include "stability/particle_cases.h"
#include "stability/smoothing_stability.h"
#include "stability/stability_map.h"
#include "stability/step_limits.h"
#include "stability/stiffness_cases.h"
#include "stability/tension_stability.h"

namespace sluice::evaluate {

namespace {

using Columns = std::vector<std::pair<std::string, std::string>>;

/// A part of the study with what its rows go into.
struct Part {
  const char* name;
  std::vector<StabilityJob> (*jobs)(const Options& options);
};

const std::vector<Part>& partsOfStudy() {
  static const std::vector<Part> parts{
      {"smoothing",
       [](const Options& options) {
         return std::vector<StabilityJob>{{"smoothing", [&options] { return smoothingStability(options); }}};
       }},
      {"particles", [](const Options& options) { return particleJobs(options.threads); }},
      {"stiffness", [](const Options& options) { return stiffnessJobs(options.quick, options.threads); }},
      {"bodies", [](const Options& options) { return bodyJobs(options.threads); }},
      {"tension", [](const Options& options) { return tensionJobs(options.threads); }},
      {"limits", [](const Options& options) { return limitJobs(options.threads); }},
      {"map", [](const Options& options) { return mapJobs(options.quick, options.threads); }}};
  return parts;
}

const Columns kSmoothingColumns{{"case", "case"},       {"method", "method"},   {"strength", "T d²"},
                                {"outcome", "outcome"}, {"largest", "largest"}, {"limit", "limit"},
                                {"passed", "passed"}};
const Columns kSolverColumns{{"case", "case"},
                             {"solver", "solver"},
                             {"outcome", "outcome"},
                             {"message", "message"},
                             {"fastest", "fastest m/s"},
                             {"compression", "compression"},
                             {"iterations_per_step", "iterations a step"},
                             {"shortest_step", "shortest step s"},
                             {"passed", "passed"}};
const Columns kLimitColumns{{"case", "case"},        {"solver", "solver"},       {"measured", "measured"},
                            {"used", "used"},        {"published", "published"}, {"linear_theory", "linear theory"},
                            {"unit", "in units of"}, {"outcome", "outcome"},     {"passed", "passed"}};

std::string describeSmoothing(const Row& row) {
  return row.text("method") + ", T = " + shortText(row.number("strength")) + " d², " + row.text("case") + ": " +
         row.text("outcome") + " (" + shortText(row.number("largest")) + " of " + shortText(row.number("limit")) + ")";
}

std::string describeSolver(const Row& row) {
  return row.text("solver") + ", " + row.text("case") + ": " + row.text("outcome");
}

/// A section of the page on rows that are there.
template <class Describe>
void report(Report& all, std::string& page, const std::string& heading, Table table, const Columns& columns,
            Describe describe) {
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

/// The rows of every part, run or, where an earlier study of the same options has left them, found.
std::vector<std::vector<Row>> runParts(const Options& options) {
  std::vector<std::pair<std::size_t, StabilityJob>> jobs;
  for (std::size_t part = 0; part < partsOfStudy().size(); ++part) {
    if (!options.only.empty() && options.only != partsOfStudy()[part].name) continue;
    for (StabilityJob& job : partsOfStudy()[part].jobs(options)) jobs.emplace_back(part, std::move(job));
  }
  RunStore store(options.folder.empty() ? options.folder : options.folder / "stability_runs.jsonl", options.resume);
  Progress progress(options, jobs.size());
  std::vector<std::vector<Row>> rows(partsOfStudy().size());
  for (const auto& [part, job] : jobs) {
    const std::string key = (options.quick ? "quick, " : "full, ") + job.name;
    const bool kept = store.find(key) != nullptr;
    progress.begin(job.name, kept);
    if (!kept) store.add(key, job.run());
    std::ranges::copy(*store.find(key), std::back_inserter(rows[part]));
  }
  return rows;
}

}  // namespace

std::vector<std::string> stabilityParts() {
  std::vector<std::string> names;
  for (const Part& part : partsOfStudy()) names.emplace_back(part.name);
  return names;
}

Report runStabilityStudy(const Options& options) {
  enum { Smoothing, Particles, Stiffness, Bodies, Tension, Limits, Map };
  std::vector<std::vector<Row>> parts = runParts(options);
  Report all;
  std::string page = "# Stability\n";
  report(all, page, "Smoothing", {"stability", std::move(parts[Smoothing])}, kSmoothingColumns, describeSmoothing);
  if (!parts[Map].empty()) {
    all.documents.push_back({"stability_map.svg", drawStabilityMap(parts[Map], processorName())});
  }
  std::vector<Row> rows;
  for (const int part : {Particles, Stiffness, Bodies, Tension, Map}) {
    std::ranges::move(parts[static_cast<std::size_t>(part)], std::back_inserter(rows));
  }
  report(all, page, "Solvers", {"stability_solvers", std::move(rows)}, kSolverColumns, describeSolver);
  report(all, page, "Longest steps", {"stability_limits", std::move(parts[Limits])}, kLimitColumns, describeSolver);
  for (const Document& map : all.documents) page += "\n![" + map.fileName + "](" + map.fileName + ")\n";
  all.documents.push_back({"stability.md", std::move(page)});
  return all;
}

}  // namespace sluice::evaluate
