#include "sluice/client/command_line.h"

#include <algorithm>
#include <exception>
#include <fstream>
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

/// The first line of the file; on the command line every user of the machine could see it.
std::string readToken(const std::string& path) {
  std::ifstream file(path);
  std::string token;
  if (!std::getline(file, token)) throw UsageError("--token-file " + path + ": no line can be read");
  if (token.ends_with('\r')) token.pop_back();
  return token;
}

/// A header ends at a line's end, and a token at white space (RFC 6750, 2.1). The token itself is not told.
void checkToken(const std::string& token) {
  const auto allowed = [](unsigned char c) { return c > ' ' && c < 0x7F; };
  if (token.empty() || !std::all_of(token.begin(), token.end(), allowed)) {
    throw UsageError("the token is empty, or holds white space or characters that are not ASCII");
  }
}

/// Options that say how the server is entered.
struct AccessOptions {
  std::string token;
  std::string tokenFile;
  std::string caFile;
  bool insecure = false;
  bool spectator = false;

  void addTo(CLI::App& app) {
    CLI::Option* text = app.add_option("--token", token, "The server's token; other users of this machine may see it");
    app.add_option("--token-file", tokenFile, "A file whose first line is the token")->excludes(text);
    app.add_flag("--spectator", spectator, "Look on only, whatever the token allows");
    CLI::Option* ca = app.add_option("--ca-file", caFile, "Certificates (PEM) to trust instead of the system's");
    app.add_flag("--insecure", insecure, "Take any certificate of a wss:// server")->excludes(ca);
  }

  Access access() const {
    Access result{.token = tokenFile.empty() ? token : readToken(tokenFile),
                  .role = spectator ? v1::SPECTATOR : v1::ROLE_UNSPECIFIED,
                  .caFile = caFile,
                  .verify = !insecure};
    if (!token.empty() || !tokenFile.empty()) checkToken(result.token);
    return result;
  }

  void appendTo(std::vector<std::string>& arguments) const {
    const auto append = [&](const char* name, const std::string& value) {
      if (!value.empty()) arguments.insert(arguments.end(), {name, value});
    };
    append("--token", token);
    append("--token-file", tokenFile);
    append("--ca-file", caFile);
    if (insecure) arguments.emplace_back("--insecure");
    if (spectator) arguments.emplace_back("--spectator");
  }
};

}  // namespace

void execute(const std::vector<std::string>& arguments, const Output& output) {
  std::string server = kDefaultServer;
  double timeoutSeconds = kDefaultTimeoutSeconds;
  bool json = false;
  AccessOptions access;
  Action chosen;

  CLI::App app(
      "Drives a running sluice-server.\n"
      "Exit codes: 0 done, 1 refused or failed, 2 bad usage, 3 cannot connect.",
      "sluice");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--server", server, "The server's address; wss:// for TLS")->capture_default_str();
  app.add_option("--timeout", timeoutSeconds, "Seconds to wait for an answer")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 86400.0));
  access.addTo(app);
  app.add_flag("--json", json, "Make the last line on stdout one JSON object");
  for (const auto add : {addInfo, addSet, addCamera, addControls, addLoad, addSnapshot, addRecord, addWatch, addViewers,
                         addInteractions, addPick, addBench, addScript}) {
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
  access.appendTo(shared);
  if (json) shared.emplace_back("--json");
  const auto timeout =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::duration<double>(timeoutSeconds));
  chosen({parseServerUrl(server), access.access(), timeout, json, output, std::move(shared)});
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
