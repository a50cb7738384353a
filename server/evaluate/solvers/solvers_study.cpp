#include "solvers/solvers_study.h"

#include <algorithm>
#include <cmath>

#include "machine.h"
#include "progress.h"
#include "solvers/page.h"
#include "solvers/run_store.h"

namespace sluice::evaluate {

namespace {

struct Job {
  const Case* solverCase;
  Method method;
  int resolution;

  std::string key() const {
    return std::string(solverCase->name) + ", " + method.text() + ", " + std::to_string(resolution);
  }
};

/// Free fall knows no solver's setting: one each is enough.
bool repeats(const Case& solverCase, const Method& method, const std::vector<Job>& jobs) {
  return solverCase.name == "free fall" && std::ranges::any_of(jobs, [&](const Job& job) {
           return job.solverCase == &solverCase && job.method.kind == method.kind && job.method.text() != method.text();
         });
}

/// The finest of several resolutions takes most of a sweep's time: there defaults alone run, to keep to an hour.
bool isTooLong(const std::vector<int>& resolutions, std::size_t level, const Method& method) {
  constexpr std::size_t kSeveral = 3;
  return resolutions.size() >= kSeveral && level + 1 == resolutions.size() && !isDefault(method);
}

/// Coarse runs of all cases first, so that a study that is cut off has something of everything.
std::vector<Job> jobsOf(const Options& options) {
  std::vector<Job> jobs;
  const std::vector<Method> methods = solverMethods(options.quick);
  std::size_t most = 0;
  for (const Case& c : solverCases()) most = std::max(most, (options.quick ? c.quick : c.full).size());
  for (std::size_t level = 0; level < most; ++level) {
    for (const Case& c : solverCases()) {
      if (!options.only.empty() && options.only != c.name) continue;
      const std::vector<int>& resolutions = options.quick ? c.quick : c.full;
      if (level >= resolutions.size()) continue;
      for (const Method& method : methods) {
        if (!c.applies(method, resolutions[level]) || repeats(c, method, jobs)) continue;
        if (isTooLong(resolutions, level, method)) continue;
        jobs.push_back({&c, method, resolutions[level]});
      }
    }
  }
  return jobs;
}

std::vector<Row> measure(const Job& job, int threads) {
  Run run(job.method, job.resolution, threads);
  const std::vector<Finding> findings = job.solverCase->run(run);
  return rowsOf(*job.solverCase, run, findings);
}

bool sameLine(const Row& a, const Row& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return a.text("case") == b.text("case") && a.text("solver") == b.text("solver") &&
         a.text("error_norm") == b.text("error_norm") && same(a.number("tolerance"), b.number("tolerance")) &&
         a.text("setting") == b.text("setting");
}

}  // namespace

std::vector<Row> rowsOf(const Case& solverCase, const Run& run, const std::vector<Finding>& findings) {
  Row common{{"case", std::string(solverCase.name)},
             {"solver", run.method().solver()},
             {"spacing", run.spacing()},
             {"particles", static_cast<std::int64_t>(run.particleCount())},
             {"tolerance", run.method().tolerance},
             {"time_step", run.meanStep()},
             {"steps", static_cast<std::int64_t>(run.steps())},
             {"iterations", static_cast<std::int64_t>(run.iterations())},
             {"wall_seconds", run.wallSeconds()}};
  std::vector<Row> rows;
  for (const Finding& finding : findings) {
    Row row = common;
    row.set("error", finding.error);
    row.set("error_norm", finding.norm);
    row.set("reference", finding.reference);
    row.set("setting", run.method().text());
    rows.push_back(std::move(row));
  }
  if (!rows.empty()) return rows;
  common.set("error", std::nan(""));
  common.set("error_norm", std::string("stopped"));
  common.set("reference", run.source().halted());
  common.set("setting", run.method().text());
  return {common};
}

std::vector<Row> convergenceOrders(const std::vector<Row>& rows) {
  std::vector<Row> orders;
  std::vector<const Row*> done;
  for (const Row& first : rows) {
    if (std::ranges::any_of(done, [&](const Row* row) { return sameLine(*row, first); })) continue;
    done.push_back(&first);
    const Row* coarsest = &first;
    const Row* finest = &first;
    for (const Row& row : rows) {
      if (!sameLine(row, first) || !(row.number("error") > 0)) continue;
      if (row.number("spacing") > coarsest->number("spacing")) coarsest = &row;
      if (row.number("spacing") < finest->number("spacing")) finest = &row;
    }
    if (coarsest == finest || !(coarsest->number("error") > 0) || !(finest->number("error") > 0)) continue;
    const double order = std::log(coarsest->number("error") / finest->number("error")) /
                         std::log(coarsest->number("spacing") / finest->number("spacing"));
    orders.push_back({{"case", first.text("case")},
                      {"solver", first.text("solver")},
                      {"tolerance", first.number("tolerance")},
                      {"setting", first.text("setting")},
                      {"error_norm", first.text("error_norm")},
                      {"coarsest", coarsest->number("spacing")},
                      {"finest", finest->number("spacing")},
                      {"order", order}});
  }
  return orders;
}

std::vector<std::string> solverParts() {
  std::vector<std::string> parts;
  for (const Case& c : solverCases()) parts.emplace_back(c.name);
  return parts;
}

Report runSolversStudy(const Options& options) {
  const std::vector<Job> jobs = jobsOf(options);
  RunStore store(options.folder.empty() ? options.folder : options.folder / "solvers_runs.jsonl", options.resume);
  Progress progress(options, jobs.size());
  std::vector<Row> rows;
  for (const Job& job : jobs) {
    const bool kept = store.find(job.key()) != nullptr;
    progress.begin(job.key(), kept);
    if (!kept) store.add(job.key(), measure(job, options.threads));
    std::ranges::copy(*store.find(job.key()), std::back_inserter(rows));
  }
  // By case again, as they were listed.
  std::ranges::stable_sort(rows, {},
                           [](const Row& row) { return &solverCase(row.text("case")) - solverCases().data(); });

  Report report;
  for (const Row& row : rows) {
    if (row.text("error_norm") != "stopped") continue;
    report.notes.push_back(row.text("case") + ", " + row.text("setting") + ", d = " + shortText(row.number("spacing")) +
                           " m: " + row.text("reference"));
  }
  std::vector<Row> orders = convergenceOrders(rows);
  const std::string machine = processorName();
  for (const auto& [caseName, norm] : plotsOf(rows)) {
    report.documents.push_back({solverPlotName(caseName), solverPlot(rows, caseName, norm, machine)});
  }
  report.documents.push_back({"solvers.md", solversPage(rows, orders, machine, options.quick)});
  for (Row& row : rows) row.erase("setting");
  report.tables.push_back({"solvers", std::move(rows)});
  report.tables.push_back({"solvers_order", std::move(orders)});
  return report;
}

}  // namespace sluice::evaluate
