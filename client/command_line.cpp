#include "sluice/client/command_line.h"

#include <algorithm>
#include <exception>
#include <ostream>
#include <sstream>

#include <CLI/CLI.hpp>

#include "sluice/client/failure.h"
#include "verbs/verb.h"

namespace sluice::client {

namespace {

constexpr const char* kDefaultServer = "ws://127.0.0.1:8080";
constexpr double kDefaultTimeoutSeconds = 10;

std::string verbNames(const CLI::App& app) {
  std::string names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + verb->get_name();
  }
  return names;
}

/// What parsing ended with: help is printed, anything else is bad usage.
void printHelpOrThrow(const CLI::App& app, const CLI::ParseError& error, const Output& output) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    std::ostringstream unused;
    app.exit(error, output.out, unused);
    return;
  }
  if (app.get_subcommands().empty()) {
    const std::vector<std::string> unknown = app.remaining();
    throw UsageError((unknown.empty() ? "a verb is missing" : "there is no verb " + inQuotes(unknown.front())) +
                     "; there are " + verbNames(app));
  }
  throw UsageError(std::string(error.what()) + "; run with --help for what is allowed");
}

}  // namespace

void execute(const std::vector<std::string>& arguments, const Output& output) {
  std::string server = kDefaultServer;
  double timeoutSeconds = kDefaultTimeoutSeconds;
  bool json = false;
  Action chosen;

  CLI::App app(
      "Drives a running sluice-server.\n"
      "Exit codes: 0 done, 1 refused or failed, 2 bad usage, 3 cannot connect.",
      "sluice");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--server", server, "The server's address")->capture_default_str();
  app.add_option("--timeout", timeoutSeconds, "Seconds to wait for an answer")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 86400.0));
  app.add_flag("--json", json, "Make the last line on stdout one JSON object");
  for (const auto add :
       {addInfo, addSet, addCamera, addControls, addLoad, addSnapshot, addRecord, addWatch, addBench, addScript}) {
    add(app, chosen);
  }

  try {
    // CLI11 takes arguments from the back.
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    printHelpOrThrow(app, error, output);
    return;
  }

  std::vector<std::string> shared = {"--server", server, "--timeout", std::to_string(timeoutSeconds)};
  if (json) shared.emplace_back("--json");
  const auto timeout =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::duration<double>(timeoutSeconds));
  chosen({parseServerUrl(server), timeout, json, output, std::move(shared)});
}

int runCommandLine(const std::vector<std::string>& arguments, Output output) {
  try {
    execute(arguments, output);
    output.out.flush();
    if (!output.out) throw RequestError("cannot write to stdout");
    return static_cast<int>(ExitCode::Done);
  } catch (const Failure& failure) {
    output.err << "sluice: " << failure.what() << '\n';
    return static_cast<int>(failure.exitCode());
  } catch (const std::exception& error) {
    output.err << "sluice: " << error.what() << '\n';
    return static_cast<int>(ExitCode::Refused);
  }
}

}  // namespace sluice::client
