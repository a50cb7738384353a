#pragma once

#include <chrono>
#include <deque>

namespace sluice::app {

/// Keeps simulated time from running ahead of `speed` × wall time, and measures the ratio reached.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// Simulated seconds per second, at most; > 0.
  void setSpeed(double speed) { speed_ = speed; }

  /// Play begins or goes on at this simulated time.
  void restart(Clock::time_point now, double simulatedTime);

  /// When the state at `simulatedTime` is due to be left. After a delay longer than kForgiven the lost time is given
  /// up instead of caught up with.
  Clock::time_point due(Clock::time_point now, double simulatedTime);

  /// To be called after each step.
  void record(Clock::time_point now, double simulatedTime);

  /// Simulated seconds per second over about the last second; 0 before there are two records.
  double realTimeFactor() const;

 private:
  static constexpr std::chrono::milliseconds kForgiven{100};

  struct Sample {
    Clock::time_point wall;
    double simulated;
  };

  double speed_ = 1;
  Sample anchor_{};
  std::deque<Sample> samples_;
};

}  // namespace sluice::app
