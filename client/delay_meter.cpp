#include "sluice/client/delay_meter.h"

#include <algorithm>

namespace sluice::client {

void DelayMeter::sent(std::uint64_t sequence, Clock::time_point when) {
  underWay_.push_back({sequence, when, frames_});
}

std::optional<double> DelayMeter::decoded(std::uint64_t reflectsSequence, Clock::time_point when) {
  ++frames_;
  std::optional<double> newest;
  while (!underWay_.empty() && underWay_.front().sequence <= reflectsSequence) {
    const Input& input = underWay_.front();
    newest = std::chrono::duration<double, std::milli>(when - input.sent).count();
    milliseconds_.push_back(*newest);
    mostFrames_ = std::max(mostFrames_, frames_ - input.framesBefore);
    underWay_.pop_front();
  }
  return newest;
}

}  // namespace sluice::client
