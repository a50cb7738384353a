#include "program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sluice::test {

namespace {

using Clock = std::chrono::steady_clock;

/// The parent's end and the child's; the child inherits neither but by dup2.
std::array<int, 2> makePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  return ends;
}

/// Appends what can be read now; closes the pipe at its end.
void drain(int& pipe, std::string& text) {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::read(pipe, bytes.data(), bytes.size());
  if (count > 0) {
    text.append(bytes.data(), static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) {
    close(pipe);
    pipe = -1;
  }
}

}  // namespace

Program::Program(const std::vector<std::string>& command) {
  const auto [outRead, outWrite] = makePipe();
  const auto [errRead, errWrite] = makePipe();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, outWrite, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errWrite, STDERR_FILENO);

  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int error = posix_spawn(&process_, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(outWrite);
  close(errWrite);
  outPipe_ = outRead;
  errPipe_ = errRead;
  if (error != 0) throw std::system_error(error, std::generic_category(), command.front());
}

Program::~Program() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  for (const int pipe : {outPipe_, errPipe_}) {
    if (pipe >= 0) close(pipe);
  }
}

bool Program::read(Clock::time_point deadline) {
  if (outPipe_ < 0 && errPipe_ < 0) return false;
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
  if (left.count() <= 0) return false;
  // A negative descriptor is passed over.
  std::array<pollfd, 2> pipes = {pollfd{outPipe_, POLLIN, 0}, pollfd{errPipe_, POLLIN, 0}};
  if (poll(pipes.data(), pipes.size(), static_cast<int>(left.count())) < 0) return errno == EINTR;
  if (pipes[0].revents != 0) drain(outPipe_, out_);
  if (pipes[1].revents != 0) drain(errPipe_, err_);
  return true;
}

std::string Program::readLine() {
  const Clock::time_point deadline = Clock::now() + kPatience;
  while (true) {
    if (const auto end = out_.find('\n', linesBegin_); end != std::string::npos) {
      const std::string line = out_.substr(linesBegin_, end - linesBegin_);
      linesBegin_ = end + 1;
      return line;
    }
    if (outPipe_ < 0 || !read(deadline)) throw std::runtime_error("no line on standard output; on the other: " + err_);
  }
}

void Program::terminate() { kill(process_, SIGTERM); }

int Program::wait() {
  const Clock::time_point deadline = Clock::now() + kPatience;
  while (read(deadline)) {
  }
  if (outPipe_ >= 0 || errPipe_ >= 0) kill(process_, SIGKILL);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Outcome runProgram(const std::vector<std::string>& command) {
  Program program(command);
  const int exitCode = program.wait();
  return {exitCode, program.out(), program.err()};
}

}  // namespace sluice::test
