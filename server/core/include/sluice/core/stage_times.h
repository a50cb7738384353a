#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace sluice::core {

struct StageTime {
  std::string name;
  double milliseconds = 0;
};

/// Named durations in the order in which the stages first ran.
using StageTimes = std::vector<StageTime>;

/// Adds `milliseconds` to the entry of that name, appending it when it is new.
void addStageTime(StageTimes& times, std::string_view name, double milliseconds);

/// Sum over all stages, ms.
double totalMilliseconds(const StageTimes& times);

/// Adds the time from its construction to its destruction to one entry of `times`, which must outlive it.
class StageTimer {
 public:
  StageTimer(StageTimes& times, std::string_view name)
      : times_(times), name_(name), start_(std::chrono::steady_clock::now()) {}
  ~StageTimer() {
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
    addStageTime(times_, name_, elapsed.count());
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  StageTimes& times_;
  std::string_view name_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sluice::core
