#pragma once

#include <string>
#include <vector>

namespace sluice::gl {

/// Collects what the driver reports about the current context, from its construction to its destruction: errors,
/// undefined behaviour and deprecated use; notes on performance are left out. Needs a context made with
/// DebugOutput::On, on whose thread it lives.
class DebugMessages {
 public:
  DebugMessages();
  ~DebugMessages();
  DebugMessages(const DebugMessages&) = delete;
  DebugMessages& operator=(const DebugMessages&) = delete;

  /// What came in since the last call, oldest first.
  std::vector<std::string> take();

  void add(std::string message) { messages_.push_back(std::move(message)); }

 private:
  std::vector<std::string> messages_;
};

}  // namespace sluice::gl
