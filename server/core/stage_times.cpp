#include "sluice/core/stage_times.h"

#include <algorithm>
#include <numeric>

namespace sluice::core {

void addStageTime(StageTimes& times, std::string_view name, double milliseconds) {
  const auto entry = std::find_if(times.begin(), times.end(), [&](const StageTime& t) { return t.name == name; });
  if (entry != times.end()) {
    entry->milliseconds += milliseconds;
  } else {
    times.push_back({std::string(name), milliseconds});
  }
}

double totalMilliseconds(const StageTimes& times) {
  return std::accumulate(times.begin(), times.end(), 0.0,
                         [](double sum, const StageTime& t) { return sum + t.milliseconds; });
}

}  // namespace sluice::core
