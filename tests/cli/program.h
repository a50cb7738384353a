#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <sys/types.h>

namespace sluice::test {

/// Longer than anything here takes on a loaded machine; only a test that fails anyway waits for it.
inline constexpr std::chrono::seconds kPatience{60};

/// A program that runs beside the test, its output caught. Stopped with it.
class Program {
 public:
  /// `command` is the program's path and its arguments. Throws std::system_error where it cannot be started.
  explicit Program(const std::vector<std::string>& command);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Reads standard output up to the end of its next line. Throws std::runtime_error, with what the program wrote on
  /// standard error, when it ends before that or the patience is over.
  std::string readLine();

  /// Asks it to end.
  void terminate();

  /// Waits for its end and returns the exit code; 128 + the signal's number where a signal ended it.
  int wait();

  // All that was written, once `wait` has returned.
  const std::string& out() const { return out_; }
  const std::string& err() const { return err_; }

 private:
  /// Takes in what has been written; false once both ends are closed or `deadline` has passed.
  bool read(std::chrono::steady_clock::time_point deadline);

  pid_t process_ = -1;
  int outPipe_ = -1;
  int errPipe_ = -1;
  std::string out_;
  std::string err_;
  std::size_t linesBegin_ = 0;
};

struct Outcome {
  int exitCode = 0;
  std::string out;
  std::string err;
};

/// Runs a program to its end.
Outcome runProgram(const std::vector<std::string>& command);

}  // namespace sluice::test
