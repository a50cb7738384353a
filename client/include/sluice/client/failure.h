#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace sluice::client {

/// What a person wrote, set off from the words of a message.
inline std::string inQuotes(std::string_view text) {
  std::string result;
  result.reserve(text.size() + 2);
  result += '\'';
  result += text;
  result += '\'';
  return result;
}

enum class ExitCode {
  Done = 0,
  Refused = 1,       ///< The server refused the request, or something failed on the way.
  Usage = 2,         ///< The command line makes no sense.
  NoConnection = 3,  ///< No server, or it went away.
};

/// Why a command ended early: one line for people, and the exit code that goes with it.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode exitCode, const std::string& message) : std::runtime_error(message), exitCode_(exitCode) {}

  ExitCode exitCode() const { return exitCode_; }

 private:
  ExitCode exitCode_;
};

class RequestError : public Failure {
 public:
  explicit RequestError(const std::string& message) : Failure(ExitCode::Refused, message) {}
};

class UsageError : public Failure {
 public:
  explicit UsageError(const std::string& message) : Failure(ExitCode::Usage, message) {}
};

class ConnectionError : public Failure {
 public:
  explicit ConnectionError(const std::string& message) : Failure(ExitCode::NoConnection, message) {}
};

}  // namespace sluice::client
