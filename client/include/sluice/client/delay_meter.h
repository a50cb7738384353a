#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace sluice::client {

/// Measures from the sending of an input to the first decoded frame that reflects it. Inputs that the server
/// overtakes with newer ones count too: the first frame to show a newer one shows them as well.
class DelayMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// Sequence numbers rise.
  void sent(std::uint64_t sequence, Clock::time_point when);
  /// Returns the delay of the newest input that this frame is the first to show, ms; none where it shows no new one.
  std::optional<double> decoded(std::uint64_t reflectsSequence, Clock::time_point when);

  bool waiting() const { return !underWay_.empty(); }
  const std::vector<double>& milliseconds() const { return milliseconds_; }
  /// The most frames that came behind an input up to and with the first that shows it: 1 where none was out of date.
  std::size_t mostFrames() const { return mostFrames_; }

 private:
  struct Input {
    std::uint64_t sequence;
    Clock::time_point sent;
    std::size_t framesBefore;  ///< Frames decoded before it was sent.
  };
  std::deque<Input> underWay_;
  std::vector<double> milliseconds_;
  std::size_t frames_ = 0;
  std::size_t mostFrames_ = 0;
};

}  // namespace sluice::client
