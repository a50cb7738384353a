#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include <omp.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "sluice/core/input_error.h"
#include "sluice/evaluate/study.h"

namespace sluice::app {

namespace {

struct EvaluateOptions {
  std::string study;
  std::string out = "evaluation";
  evaluate::Options options;
  int threads = 0;
  bool json = false;
};

constexpr int kCaseFailed = 1;

/// One report of several: tables in the order of the studies, the first study's first.
void append(evaluate::Report& all, evaluate::Report report) {
  const auto moveTo = [](auto& to, auto& from) { std::move(from.begin(), from.end(), std::back_inserter(to)); };
  moveTo(all.tables, report.tables);
  moveTo(all.documents, report.documents);
  moveTo(all.notes, report.notes);
  moveTo(all.failures, report.failures);
}

int runStudies(EvaluateOptions& given) {
  const std::vector<evaluate::Study> studies = evaluate::findStudies(given.study, given.options.only);
  if (given.threads > 0) omp_set_num_threads(given.threads);
  given.options.threads = given.threads;
  given.options.folder = given.out;
  std::error_code error;
  std::filesystem::create_directories(given.options.folder, error);
  if (error) throw core::InputError(given.out, "--out", "cannot be made: " + error.message());

  evaluate::Report all;
  for (const evaluate::Study& study : studies) {
    const std::string name(study.name);
    given.options.progress = [&](const std::string& part) {
      // One line that changes where a person watches.
      std::fprintf(stderr, isatty(STDERR_FILENO) ? "\r\033[K%s: %s" : "%s: %s\n", name.c_str(), part.c_str());
    };
    append(all, study.run(given.options));
  }
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\033[K");

  const std::vector<std::filesystem::path> files = evaluate::writeReport(all, given.out);
  for (const std::string& note : all.notes) std::printf("note: %s\n", note.c_str());
  for (const std::string& failure : all.failures) std::printf("failed: %s\n", failure.c_str());
  for (const std::filesystem::path& file : files) std::printf("wrote %s\n", file.c_str());
  if (given.json) std::printf("%s\n", evaluate::toJson(all, files).dump().c_str());
  return all.failures.empty() ? 0 : kCaseFailed;
}

}  // namespace

void addEvaluateCommand(CLI::App& program, Command& chosen) {
  const auto given = std::make_shared<EvaluateOptions>();
  CLI::App& verb = *program.add_subcommand("evaluate", "Measure error against time, and write tables and plots");
  std::string doc = "all, or:";
  for (const evaluate::Study& study : evaluate::studies()) {
    doc += "\n" + std::string(study.name) + ": " + std::string(study.doc);
  }
  verb.add_option("STUDY", given->study, doc)->required();
  verb.add_flag("--quick", given->options.quick, "Fewer cases, in about a minute a study");
  verb.add_option("--out", given->out, "Folder to write tables, plots and pages to")->capture_default_str();
  verb.add_option("--only", given->options.only, "One part of the study");
  verb.add_option("--particles", given->options.particles, "A particle file to study beside the made shapes");
  verb.add_option("--set", given->options.assignments, "PATH=VALUE: change a field of the studies' scenes")
      ->allow_extra_args(false)
      ->take_all();
  verb.add_option("--seed", given->options.seed, "Seed of the shapes' particles")->capture_default_str();
  verb.add_option("--threads", given->threads,
                  "Threads that simulate and trace reference surfaces; 0: one for each core")
      ->check(CLI::Range(0, 1024));
  verb.add_flag("--resume", given->options.resume,
                "Go on with a study that was cut off, from what it has left in --out");
  verb.add_flag("--json", given->json, "Print rows and files as one JSON object on the last line");
  verb.callback([given, &chosen] { chosen = [given] { return runStudies(*given); }; });
}

}  // namespace sluice::app
