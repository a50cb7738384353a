#include "stability/stability_study.h"

#include <algorithm>
#include <array>

#include "stability/smoothing_stability.h"

namespace sluice::evaluate {

namespace {

struct Part {
  std::string_view name;
  std::vector<Row> (*run)(const Options& options);
};

constexpr std::array kParts{Part{"smoothing", smoothingStability}};

std::string describe(const Row& row) {
  return row.text("method") + ", T = " + shortText(row.number("strength")) + " d², " + row.text("case") + ": " +
         row.text("outcome") + " (" + shortText(row.number("largest")) + " of " + shortText(row.number("limit")) + ")";
}

}  // namespace

std::vector<std::string> stabilityParts() {
  std::vector<std::string> parts;
  for (const Part& part : kParts) parts.emplace_back(part.name);
  return parts;
}

Report runStabilityStudy(const Options& options) {
  Report report;
  Table table{"stability", {}};
  for (const Part& part : kParts) {
    if (!options.only.empty() && options.only != part.name) continue;
    std::ranges::move(part.run(options), std::back_inserter(table.rows));
  }
  for (const Row& row : table.rows) {
    if (!row.flag("passed")) report.failures.push_back(describe(row));
  }
  const std::size_t failed = report.failures.size();
  std::string page =
      "# Stability\n\n" + std::to_string(table.rows.size()) + " cases, " + std::to_string(failed) + " failed.\n\n";
  page += toMarkdown(table.rows, {{"case", "case"},
                                  {"method", "method"},
                                  {"strength", "T d²"},
                                  {"outcome", "outcome"},
                                  {"largest", "largest"},
                                  {"limit", "limit"},
                                  {"passed", "passed"}});
  report.documents.push_back({"stability.md", std::move(page)});
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace sluice::evaluate
