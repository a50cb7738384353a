#include "sluice/app/pace.h"

#include <gtest/gtest.h>

namespace sluice::app {
namespace {

using namespace std::chrono_literals;

TEST(Pace, KeepsSimulatedTimeFromRunningAhead) {
  const Pace::Clock::time_point start = Pace::Clock::now();
  Pace pace;
  pace.restart(start, 2.0);
  EXPECT_EQ(pace.due(start, 2.5), start + 500ms);
  pace.setSpeed(2.0);
  EXPECT_EQ(pace.due(start, 2.5), start + 250ms);
}

TEST(Pace, GivesUpTimeLostToADelay) {
  const Pace::Clock::time_point start = Pace::Clock::now();
  Pace pace;
  pace.restart(start, 0);
  EXPECT_EQ(pace.due(start + 10s, 0.0), start + 10s);
  EXPECT_EQ(pace.due(start + 10s, 0.02), start + 10s + 20ms) << "no rush to catch up";
}

TEST(Pace, CatchesUpWithAShortHitch) {
  const Pace::Clock::time_point start = Pace::Clock::now();
  Pace pace;
  pace.restart(start, 0);
  EXPECT_EQ(pace.due(start + 50ms, 0.02), start + 20ms);
}

TEST(Pace, MeasuresTheRatioOfTheLastSecond) {
  const Pace::Clock::time_point start = Pace::Clock::now();
  Pace pace;
  pace.restart(start, 0);
  EXPECT_EQ(pace.realTimeFactor(), 0);
  for (int k = 0; k <= 100; ++k) pace.record(start + k * 10ms, k * 0.01);
  EXPECT_NEAR(pace.realTimeFactor(), 1.0, 1e-9);
  for (int k = 1; k <= 200; ++k) pace.record(start + 1s + k * 10ms, 1.0 + k * 0.0025);
  EXPECT_NEAR(pace.realTimeFactor(), 0.25, 1e-9);
}

}  // namespace
}  // namespace sluice::app
