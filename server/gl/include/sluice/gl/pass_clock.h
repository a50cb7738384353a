#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/core/stage_times.h"
#include "sluice/gl/objects.h"

namespace sluice::gl {

/// Times the passes of one frame after another. On a GPU it writes timestamps between the passes and reads them once
/// the frame is done. On software GL such timestamps say when commands were queued, not when they ran, so there it
/// waits for each pass to end and reads the clock. Lives on the thread of its context.
class PassClock {
 public:
  explicit PassClock(bool software) : software_(software) {}

  /// Starts a frame.
  void start();

  /// The work queued since `start` or the last `lap` was `name`.
  void lap(std::string_view name);

  /// Milliseconds of every lap since `start`. Waits for the work to end.
  core::StageTimes finish();

 private:
  using Clock = std::chrono::steady_clock;

  void stamp();

  bool software_;
  std::vector<std::string> names_;
  std::vector<Clock::time_point> times_;
  std::vector<Query> queries_;  ///< GPU alone; kept from frame to frame.
};

}  // namespace sluice::gl
