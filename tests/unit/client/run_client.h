#pragma once

#include <string>
#include <vector>

#include "fake_server.h"
#include "print_json.h"
#include "sluice/client/json.h"

namespace sluice::client {

/// How a run of the program ended, and what it wrote.
struct Outcome {
  int exitCode = 0;
  std::string out;
  std::string err;

  /// The last line of `out`.
  Json json() const;
};

/// Runs the program in this process.
Outcome run(std::vector<std::string> arguments, bool terminal = false);

/// The same, with that server named at the end.
Outcome run(const FakeServer& server, std::vector<std::string> arguments);

/// What a server says that refuses everything but to greet.
Reaction refuse(const v1::ClientMessage& message);

}  // namespace sluice::client
