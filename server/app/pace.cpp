#include "sluice/app/pace.h"

namespace sluice::app {

namespace {

using Seconds = std::chrono::duration<double>;

}  // namespace

void Pace::restart(Clock::time_point now, double simulatedTime) {
  anchor_ = {now, simulatedTime};
  samples_.clear();
}

Pace::Clock::time_point Pace::due(Clock::time_point now, double simulatedTime) {
  const auto due =
      anchor_.wall + std::chrono::duration_cast<Clock::duration>(Seconds((simulatedTime - anchor_.simulated) / speed_));
  if (now - due > kForgiven) {
    anchor_ = {now, simulatedTime};
    return now;
  }
  return due;
}

void Pace::record(Clock::time_point now, double simulatedTime) {
  samples_.push_back({now, simulatedTime});
  while (samples_.size() > 2 && now - samples_.front().wall > std::chrono::seconds(1)) samples_.pop_front();
}

double Pace::realTimeFactor() const {
  if (samples_.size() < 2) return 0;
  const double wall = Seconds(samples_.back().wall - samples_.front().wall).count();
  return wall > 0 ? (samples_.back().simulated - samples_.front().simulated) / wall : 0;
}

}  // namespace sluice::app
