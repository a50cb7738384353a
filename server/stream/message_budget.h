#pragma once

#include <algorithm>
#include <chrono>

namespace sluice::stream {

/// Bounds how many messages a viewer may send: so many a second on average, and two seconds' worth at once (a token
/// bucket). Not thread-safe.
class MessageBudget {
 public:
  using Clock = std::chrono::steady_clock;

  /// `perSecond` > 0.
  MessageBudget(double perSecond, Clock::time_point now)
      : perSecond_(perSecond), burst_(std::max(2 * perSecond, 1.0)), left_(burst_), last_(now) {}

  /// Takes one message in, and says how long to wait before the next is read: nothing within the budget.
  Clock::duration take(Clock::time_point now) {
    const double elapsed = std::chrono::duration<double>(now - last_).count();
    left_ = std::min(burst_, left_ + perSecond_ * elapsed) - 1;
    last_ = now;
    if (left_ >= 0) return {};
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(-left_ / perSecond_));
  }

 private:
  double perSecond_;
  double burst_;
  double left_;
  Clock::time_point last_;
};

}  // namespace sluice::stream
