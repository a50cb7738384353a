#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <vector>

namespace sluice::client {

/// Measures from the sending of an input to the first decoded frame that reflects it. Inputs that the server
/// overtakes with newer ones count too: the first frame to show a newer one shows them as well.
class DelayMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// Sequence numbers rise.
  void sent(std::uint64_t sequence, Clock::time_point when);
  void decoded(std::uint64_t reflectsSequence, Clock::time_point when);

  bool waiting() const { return !underWay_.empty(); }
  const std::vector<double>& milliseconds() const { return milliseconds_; }

 private:
  struct Input {
    std::uint64_t sequence;
    Clock::time_point sent;
  };
  std::deque<Input> underWay_;
  std::vector<double> milliseconds_;
};

}  // namespace sluice::client
