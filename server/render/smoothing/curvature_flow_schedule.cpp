#include "smoothing/curvature_flow_schedule.h"

#include <algorithm>
#include <cmath>

namespace sluice::render {

double largestStableStep(const SurfaceTraits& traits) {
  const double footprint = traits.pixelSlope * traits.nearestDepth;
  const double slopeX = 0.5 * traits.pixelSlope * traits.size.width;
  const double slopeY = 0.5 * traits.pixelSlope * traits.size.height;
  const double squaredSlope = slopeX * slopeX + slopeY * slopeY;
  const double sigma = std::sqrt(1 + squaredSlope) * (1 + 0.5 * squaredSlope);
  return footprint * footprint / (2 * sigma);
}

FlowSchedule scheduleSteps(double wantedTime, double largestStep, double stepFraction, unsigned maxIterations) {
  FlowSchedule schedule;
  schedule.wantedTime = wantedTime;
  const double needed = std::ceil(wantedTime / (stepFraction * largestStep));
  const auto allowed = static_cast<double>(maxIterations);
  const auto roundUpToEven = [](double n) { return static_cast<int>(2 * std::ceil(n / 2)); };
  if (needed <= allowed) {
    schedule.iterations = roundUpToEven(needed);
    schedule.stepTime = wantedTime / std::max(1, schedule.iterations);
  } else {
    schedule.iterations = roundUpToEven(allowed);
    schedule.stepTime = stepFraction * largestStep;
    schedule.shortfall = std::max(0.0, 1 - schedule.iterations * schedule.stepTime / wantedTime);
  }
  return schedule;
}

void reportShortfall(const FlowSchedule& schedule, SmoothingPlan& plan) {
  if (schedule.shortfall <= 0) return;
  plan.leftOut.push_back(
      {"the last " + std::to_string(std::lround(100 * schedule.shortfall)) + " % of the smoothing time",
       "max_iterations is reached"});
}

}  // namespace sluice::render
