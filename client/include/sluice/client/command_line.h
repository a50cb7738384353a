#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace sluice::client {

/// Where a command writes.
struct Output {
  std::ostream& out;
  std::ostream& err;
  bool terminal = false;  ///< `out` is a terminal, on which lines can be drawn over.
};

/// Runs one command line (without the program's name) and returns the exit code. Failures are told on `err`.
int runCommandLine(const std::vector<std::string>& arguments, Output output);

}  // namespace sluice::client
