#include "sluice/app/viewer_schedule.h"

#include <chrono>

#include <gtest/gtest.h>

namespace sluice::app {
namespace {

using namespace std::chrono_literals;

constexpr core::ViewerId kAnn = 1;
constexpr core::ViewerId kBob = 2;

class ViewerScheduleTest : public testing::Test {
 protected:
  static stream::View view(double maxRate = 1000) { return {.size = {640, 480}, .maxRate = maxRate}; }
  std::optional<ViewerSchedule::Job> next(std::chrono::milliseconds at = 0ms) { return schedule_.next(start_ + at); }

  ViewerSchedule::Clock::time_point start_ = ViewerSchedule::Clock::now();
  ViewerSchedule schedule_{2};
};

TEST_F(ViewerScheduleTest, DrawsNothingBeforeAView) {
  schedule_.join(kAnn, {});
  schedule_.contentChanged();
  EXPECT_FALSE(next());
}

TEST_F(ViewerScheduleTest, DrawsOnceUntilSomethingChanges) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view());
  const auto job = next();
  ASSERT_TRUE(job);
  EXPECT_EQ(job->viewer, kAnn);
  EXPECT_EQ(job->frameId, 1U);
  EXPECT_EQ(job->reflectsSequence, 1U);
  EXPECT_FALSE(next(1s));
  schedule_.contentChanged();
  EXPECT_TRUE(next(1s));
}

TEST_F(ViewerScheduleTest, OnlyTheNewestCameraIsDrawn) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view());
  core::Camera last;
  for (std::uint64_t sequence = 2; sequence <= 9; ++sequence) {
    last.eye.x() = static_cast<float>(sequence);
    schedule_.setCamera(kAnn, sequence, last);
  }
  const auto job = next();
  ASSERT_TRUE(job);
  EXPECT_EQ(job->reflectsSequence, 9U);
  EXPECT_EQ(job->camera, last);
  EXPECT_FALSE(next(1s));
}

TEST_F(ViewerScheduleTest, KeepsAtMostTheWindowUnderWay) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view());
  int drawn = 0;
  for (auto at = 0ms; at < 1s; at += 10ms) {
    schedule_.contentChanged();
    if (next(at)) ++drawn;
  }
  EXPECT_EQ(drawn, 2);
  schedule_.acknowledge(kAnn, 1);
  EXPECT_TRUE(next(2s));
  EXPECT_FALSE(next(3s));
}

TEST_F(ViewerScheduleTest, AcknowledgingAFrameCoversEarlierOnes) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view());
  next(0ms);
  schedule_.contentChanged();
  next(10ms);
  schedule_.acknowledge(kAnn, 2);
  schedule_.acknowledge(kAnn, 1);  // late, and without effect
  for (int frame = 0; frame < 2; ++frame) {
    schedule_.contentChanged();
    EXPECT_TRUE(next(1s + frame * 10ms)) << frame;
  }
}

TEST_F(ViewerScheduleTest, AcknowledgingWhatWasNeverDrawnOpensNothing) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view());
  schedule_.acknowledge(kAnn, 1000);
  int drawn = 0;
  for (auto at = 0ms; at < 1s; at += 10ms) {
    schedule_.contentChanged();
    if (next(at)) ++drawn;
  }
  EXPECT_EQ(drawn, 2);
}

TEST_F(ViewerScheduleTest, StaysBelowTheRateAsked) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(10));
  int drawn = 0;
  for (auto at = 0ms; at < 1s; at += 5ms) {
    schedule_.contentChanged();
    if (const auto job = next(at)) {
      ++drawn;
      schedule_.acknowledge(kAnn, job->frameId);
    }
  }
  EXPECT_EQ(drawn, 10);
}

TEST_F(ViewerScheduleTest, TellsWhenTheRateAllowsTheNext) {
  schedule_.join(kAnn, {});
  EXPECT_FALSE(schedule_.nextDue());
  schedule_.setView(kAnn, 1, view(10));
  next();
  EXPECT_FALSE(schedule_.nextDue()) << "nothing changed";
  schedule_.contentChanged();
  EXPECT_EQ(schedule_.nextDue(), start_ + 100ms);
  EXPECT_FALSE(next(99ms));
  EXPECT_TRUE(next(100ms));
}

TEST_F(ViewerScheduleTest, ServesViewersInTurn) {
  for (const core::ViewerId viewer : {kAnn, kBob}) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, view());
  }
  int annsTurns = 0;
  for (int k = 0; k < 100; ++k) {
    schedule_.contentChanged();
    const auto job = next(k * 10ms);
    ASSERT_TRUE(job);
    annsTurns += job->viewer == kAnn ? 1 : 0;
    schedule_.acknowledge(job->viewer, job->frameId);
  }
  EXPECT_EQ(annsTurns, 50);
}

TEST_F(ViewerScheduleTest, AViewerThatNeverAcknowledgesDelaysNobody) {
  for (const core::ViewerId viewer : {kAnn, kBob}) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, view());
  }
  int bobs = 0;
  for (int k = 0; k < 50; ++k) {
    schedule_.contentChanged();
    for (auto job = next(k * 10ms); job; job = next(k * 10ms)) {
      if (job->viewer != kBob) continue;
      ++bobs;
      schedule_.acknowledge(kBob, job->frameId);
    }
  }
  EXPECT_EQ(bobs, 50);
}

TEST_F(ViewerScheduleTest, SnapshotsStandOutsideTheWindow) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view());
  next(0ms);
  schedule_.contentChanged();
  next(10ms);
  core::Camera aside;
  aside.eye.x() = 7;
  EXPECT_TRUE(schedule_.requestSnapshot(kAnn, 5, {100, 50}, aside));
  EXPECT_FALSE(schedule_.requestSnapshot(kAnn, 6, {100, 50}, aside)) << "one at a time";
  const auto job = next(20ms);
  ASSERT_TRUE(job);
  EXPECT_EQ(job->inReplyTo, 5U);
  EXPECT_EQ(job->view.size, (core::ImageSize{100, 50}));
  EXPECT_EQ(job->view.codec, core::Codec::Png);
  EXPECT_EQ(job->camera, aside);
}

TEST_F(ViewerScheduleTest, StartCameraMovesOnlyThoseWithoutTheirOwn) {
  core::Camera own;
  own.eye.x() = 7;
  for (const core::ViewerId viewer : {kAnn, kBob}) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, view());
  }
  schedule_.setCamera(kAnn, 2, own);
  core::Camera start;
  start.eye.x() = -3;
  schedule_.setStartCamera(start);
  EXPECT_EQ(next(0ms)->camera, own);
  EXPECT_EQ(next(1ms)->camera, start);
}

TEST_F(ViewerScheduleTest, ViewersThatLeftAreForgotten) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view());
  schedule_.leave(kAnn);
  schedule_.setCamera(kAnn, 2, {});
  EXPECT_FALSE(next());
  EXPECT_FALSE(schedule_.requestSnapshot(kAnn, 3, {1, 1}, std::nullopt));
  EXPECT_EQ(schedule_.size(), 0U);
}

}  // namespace
}  // namespace sluice::app
