#include "smoothing/curvature_flow_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

#include "smoothing/rkl_stages.h"

namespace sluice::render {
namespace {

/// What one step makes of y = 1 under y_t = −y over a time of `x`.
double amplification(int stages, double x) {
  double last = 1;
  double before = 0;
  for (const RklStage& stage : rklStages(stages)) {
    const double next =
        1 + stage.last * (last - 1) + stage.before * (before - 1) - x * (stage.rate * last + stage.startRate);
    before = last;
    last = next;
  }
  return last;
}

TEST(RklStages, AreOfSecondOrder) {
  for (const int stages : {3, 5, 9, 21}) {
    const double error = std::abs(amplification(stages, 0.02) - std::exp(-0.02));
    const double half = std::abs(amplification(stages, 0.01) - std::exp(-0.01));
    EXPECT_NEAR(std::log2(error / half), 3, 0.1) << stages << " stages";
  }
}

TEST(RklStages, DampEverythingUpToTheirLength) {
  // Forward Euler is stable up to x = 2, a step of s stages up to as many times that as it is long.
  for (const int stages : {3, 5, 9, 21, kMostRklStages}) {
    const double longest = 2 * rklLength(stages);
    for (int i = 1; i <= 2000; ++i) EXPECT_LE(std::abs(amplification(stages, longest * i / 2000)), 1 + 1e-9) << i;
    // An odd number of stages stays stable a little longer.
    EXPECT_GT(std::abs(amplification(stages, 1.5 * longest)), 1);
  }
}

TEST(LongSteps, TakeTheStagesThatTheyNeed) {
  const FlowSchedule schedule = scheduleLongSteps(60, 0.1, 6);
  EXPECT_EQ(schedule.iterations, 6);
  EXPECT_DOUBLE_EQ(schedule.stepTime, 10);
  EXPECT_EQ(schedule.stages % 2, 1);
  EXPECT_GE(0.1 * rklLength(schedule.stages), 10);
  EXPECT_LT(0.1 * rklLength(schedule.stages - 2), 10);
  EXPECT_EQ(schedule.shortfall, 0);
}

TEST(LongSteps, SayWhatTheyCutOff) {
  const FlowSchedule schedule = scheduleLongSteps(1e6, 0.1, 2);
  EXPECT_EQ(schedule.stages, kMostRklStages);
  EXPECT_NEAR(schedule.iterations * schedule.stepTime, (1 - schedule.shortfall) * 1e6, 1);
  EXPECT_GT(schedule.shortfall, 0.9);
}

TEST(Steps, AreAsManyAsTheTimeNeeds) {
  EXPECT_EQ(scheduleSteps(1.3, 0.1, 1, 400).iterations, 13);
  EXPECT_EQ(scheduleSteps(1.3, 0.1, 0.5, 400).iterations, 26);
  const FlowSchedule cut = scheduleSteps(10, 0.1, 0.9, 15);
  EXPECT_EQ(cut.iterations, 15);
  EXPECT_DOUBLE_EQ(cut.stepTime, 0.09);
  EXPECT_NEAR(cut.shortfall, 1 - 15 * 0.09 / 10, 1e-12);
}

}  // namespace
}  // namespace sluice::render
