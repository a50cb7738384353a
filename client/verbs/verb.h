#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "sluice/client/command_line.h"
#include "sluice/client/connection.h"
#include "sluice/client/server_url.h"

namespace sluice::client {

/// What every verb is given.
struct Context {
  ServerUrl server;
  Access access;
  std::chrono::milliseconds timeout{};
  bool json = false;
  Output output;
  /// The options above as arguments, for a verb that runs other command lines.
  std::vector<std::string> sharedArguments;

  Connection connect() const { return Connection(server, timeout, access); }
};

/// What the command line chose to do. Throws Failure.
using Action = std::function<void(const Context&)>;

// Each adds a verb to the command line, which stores what it does in `chosen` when parsing meets it.

void addInfo(CLI::App& app, Action& chosen);
void addSet(CLI::App& app, Action& chosen);
void addCamera(CLI::App& app, Action& chosen);
void addControls(CLI::App& app, Action& chosen);  ///< play, pause, step, reset
void addLoad(CLI::App& app, Action& chosen);
void addSnapshot(CLI::App& app, Action& chosen);
void addInteractions(CLI::App& app, Action& chosen);  ///< push, pull, add
void addPick(CLI::App& app, Action& chosen);
void addViewers(CLI::App& app, Action& chosen);
void addRecord(CLI::App& app, Action& chosen);
void addWatch(CLI::App& app, Action& chosen);
void addBench(CLI::App& app, Action& chosen);
void addScript(CLI::App& app, Action& chosen);

/// Runs one command line as runCommandLine does, but lets Failure through. `arguments` asking for help prints it.
void execute(const std::vector<std::string>& arguments, const Output& output);

}  // namespace sluice::client
