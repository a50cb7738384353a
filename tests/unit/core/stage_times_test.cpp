#include "sluice/core/stage_times.h"

#include <gtest/gtest.h>

namespace sluice::core {
namespace {

TEST(StageTimes, AddUpUnderOneName) {
  StageTimes times;
  addStageTime(times, "splat", 1);
  addStageTime(times, "smooth", 2);
  addStageTime(times, "splat", 3);
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].name, "splat") << "in the order in which they first ran";
  EXPECT_EQ(times[0].milliseconds, 4);
  EXPECT_EQ(totalMilliseconds(times), 6);
}

TEST(StageTimes, OfNothingAreZero) { EXPECT_EQ(totalMilliseconds({}), 0); }

TEST(StageTimer, AddsWhatPassedWithinItsScope) {
  StageTimes times;
  const auto before = std::chrono::steady_clock::now();
  {
    const StageTimer timer(times, "wait");
    while (std::chrono::steady_clock::now() == before) {
    }
  }
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - before;
  ASSERT_EQ(times.size(), 1U);
  EXPECT_GE(times[0].milliseconds, 0);
  EXPECT_LE(times[0].milliseconds, passed.count());
}

}  // namespace
}  // namespace sluice::core
