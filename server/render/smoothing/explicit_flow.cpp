#include "smoothing/explicit_flow.h"

#include <algorithm>
#include <utility>

#include "sluice/core/check.h"

namespace sluice::render {

namespace {

RowSpan liquidSpan(std::span<const float> row) {
  const auto isLiquid = [](float q) { return q > 0.0F; };
  const auto first = std::ranges::find_if(row, isLiquid);
  if (first == row.end()) return {};
  const auto last = std::find_if(row.rbegin(), row.rend(), isLiquid);
  return {static_cast<int>(first - row.begin()), static_cast<int>(row.rend() - last)};
}

}  // namespace

ExplicitFlowRow ExplicitFlow::rowOf(const PaddedField& picture, int y) const {
  const float c = settings_.pixelSlope;
  const auto slope = [c](int pixel, int count) {
    return c * (static_cast<float>(pixel) + 0.5F - 0.5F * static_cast<float>(count));
  };
  return {picture.row(y - 1),
          picture.row(y),
          picture.row(y + 1),
          spans_[static_cast<std::size_t>(y)],
          slope(0, size_.width),
          slope(y, size_.height),
          c,
          settings_.edge};
}

void ExplicitFlow::run(std::span<float> q, core::ImageSize size, const ExplicitFlowSettings& settings,
                       const FlowSchedule& schedule) {
  const auto width = static_cast<std::size_t>(size.width);
  SLUICE_CHECK_EQ(q.size(), width * static_cast<std::size_t>(size.height));
  size_ = size;
  settings_ = settings;
  spans_.resize(static_cast<std::size_t>(size.height));
  const bool isRkl = schedule.stages > 1;
  for (PaddedField* field : {&picture_, &other_}) field->fit(size.width, size.height);
  if (isRkl) {
    for (PaddedField* field : {&start_, &startRate_}) field->fit(size.width, size.height);
  }
  const auto source = [&](int y) { return q.subspan(width * static_cast<std::size_t>(y), width); };
  for (int y = 0; y < size.height; ++y) {
    spans_[static_cast<std::size_t>(y)] = liquidSpan(source(y));
    // Both need the zeros where there is no liquid, which no step writes.
    for (PaddedField* field : {&picture_, &other_}) std::ranges::copy(source(y), field->row(y));
  }
  const PaddedField* const result = isRkl ? runRkl(schedule) : runEuler(schedule);
  for (int y = 0; y < size.height; ++y) std::copy_n(result->row(y), width, source(y).begin());
}

PaddedField* ExplicitFlow::runEuler(const FlowSchedule& schedule) {
  const auto time = static_cast<float>(schedule.stepTime);
#pragma omp parallel
  {
    PaddedField* from = &picture_;
    PaddedField* to = &other_;
    for (int i = 0; i < schedule.iterations; ++i) {
#pragma omp for schedule(static)
      for (int y = 0; y < size_.height; ++y) eulerStep(rowOf(*from, y), time, to->row(y));
      std::swap(from, to);
    }
  }
  return schedule.iterations % 2 == 0 ? &picture_ : &other_;
}

PaddedField* ExplicitFlow::runRkl(const FlowSchedule& schedule) {
  const auto time = static_cast<float>(schedule.stepTime);
  const std::vector<RklStage> stages = rklStages(schedule.stages);
#pragma omp parallel
  {
    PaddedField* last = &picture_;
    PaddedField* before = &other_;
    for (int i = 0; i < schedule.iterations; ++i) {
#pragma omp for schedule(static)
      for (int y = 0; y < size_.height; ++y) {
        const ExplicitFlowRow row = rowOf(*last, y);
        std::copy(row.q + row.span.first, row.q + row.span.last, start_.row(y) + row.span.first);
        flowRates(row, startRate_.row(y));
      }
      for (const RklStage& stage : stages) {
#pragma omp for schedule(static)
        for (int y = 0; y < size_.height; ++y) {
          rklStep(rowOf(*last, y), stage, time, {start_.row(y), startRate_.row(y), before->row(y)});
        }
        std::swap(last, before);
      }
    }
  }
  return schedule.iterations * schedule.stages % 2 == 0 ? &picture_ : &other_;
}

}  // namespace sluice::render
