#pragma once

#include <stdexcept>
#include <string>

namespace sluice::core {

/// Something a person gave that cannot be taken: a file, a field, a value. The message is one line that names the
/// place, the value and what is allowed. Caught in `main` (exit code 2) or at the session (an Error message).
class InputError : public std::runtime_error {
 public:
  /// `where` is a file with line and column ("pool.textproto:14:3"), a file alone, or empty; `fieldPath` is a path as
  /// in --set ("simulation.fluids[0].viscosity") or empty; `problem` says what is wrong and what is allowed.
  InputError(std::string where, std::string fieldPath, std::string problem);

  const std::string& where() const { return where_; }
  const std::string& fieldPath() const { return fieldPath_; }
  const std::string& problem() const { return problem_; }

 private:
  std::string where_;
  std::string fieldPath_;
  std::string problem_;
};

/// Something the machine lacks: a usable EGL, a free port, memory. One line; exit code 1.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sluice::core
