#include "statistics.h"

#include <algorithm>
#include <string_view>

namespace sluice::app {

namespace {

double valueOf(const core::StageTimes& times, std::string_view name) {
  const auto entry = std::find_if(times.begin(), times.end(), [&](const core::StageTime& t) { return t.name == name; });
  return entry == times.end() ? 0 : entry->milliseconds;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

core::StageTimes medianStageTimes(const std::vector<core::StageTimes>& runs) {
  core::StageTimes result;
  for (const core::StageTimes& run : runs) {
    for (const core::StageTime& stage : run) core::addStageTime(result, stage.name, 0);
  }
  for (core::StageTime& stage : result) {
    std::vector<double> values;
    for (const core::StageTimes& run : runs) values.push_back(valueOf(run, stage.name));
    stage.milliseconds = median(std::move(values));
  }
  return result;
}

core::StageTimes meanStageTimes(const core::StageTimes& sums, std::size_t runs) {
  core::StageTimes result = sums;
  for (core::StageTime& stage : result) stage.milliseconds /= static_cast<double>(std::max<std::size_t>(runs, 1));
  return result;
}

}  // namespace sluice::app
