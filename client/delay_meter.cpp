#include "sluice/client/delay_meter.h"

namespace sluice::client {

void DelayMeter::sent(std::uint64_t sequence, Clock::time_point when) { underWay_.push_back({sequence, when}); }

void DelayMeter::decoded(std::uint64_t reflectsSequence, Clock::time_point when) {
  while (!underWay_.empty() && underWay_.front().sequence <= reflectsSequence) {
    milliseconds_.push_back(std::chrono::duration<double, std::milli>(when - underWay_.front().sent).count());
    underWay_.pop_front();
  }
}

}  // namespace sluice::client
