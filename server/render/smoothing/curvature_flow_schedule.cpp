#include "smoothing/curvature_flow_schedule.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "smoothing/rkl_stages.h"

namespace sluice::render {

namespace {

/// What `iterations` of at most `longest` each make of the time that is wanted.
FlowSchedule makeSchedule(double wantedTime, double longest, int iterations) {
  FlowSchedule schedule;
  schedule.wantedTime = wantedTime;
  schedule.iterations = iterations;
  schedule.stepTime = std::min(longest, wantedTime / std::max(1, iterations));
  // Below 1e-9 it is round-off.
  const double shortfall = 1 - iterations * longest / wantedTime;
  if (shortfall > 1e-9) schedule.shortfall = shortfall;
  return schedule;
}

}  // namespace

double largestStableStep(const SurfaceTraits& traits) {
  const double footprint = traits.pixelSlope * traits.nearestDepth;
  const double slopeX = 0.5 * traits.pixelSlope * traits.size.width;
  const double slopeY = 0.5 * traits.pixelSlope * traits.size.height;
  const double squaredSlope = slopeX * slopeX + slopeY * slopeY;
  const double sigma = std::sqrt(1 + squaredSlope) * (1 + 0.5 * squaredSlope);
  return footprint * footprint / (2 * sigma);
}

FlowSchedule scheduleSteps(double wantedTime, double largestStep, double stepFraction, unsigned maxIterations) {
  const double longest = stepFraction * largestStep;
  const double needed = std::ceil(wantedTime / longest);
  return makeSchedule(wantedTime, longest, static_cast<int>(std::min<double>(needed, maxIterations)));
}

FlowSchedule scheduleLongSteps(double wantedTime, double largestStep, unsigned steps) {
  int stages = 3;
  while (stages < kMostRklStages && largestStep * rklLength(stages) * steps < wantedTime) stages += 2;
  FlowSchedule schedule = makeSchedule(wantedTime, largestStep * rklLength(stages), static_cast<int>(steps));
  schedule.stages = stages;
  return schedule;
}

void reportShortfall(const FlowSchedule& schedule, std::string reason, SmoothingPlan& plan) {
  if (schedule.shortfall <= 0) return;
  plan.leftOut.push_back(
      {"the last " + std::to_string(std::lround(100 * schedule.shortfall)) + " % of the smoothing time",
       std::move(reason)});
}

}  // namespace sluice::render
