// When a viewer is due, what it is sent, and that viewers share fairly.

#include <chrono>
#include <map>

#include <gtest/gtest.h>

#include "viewer_schedule_fixture.h"

namespace sluice::app {
namespace {

using namespace std::chrono_literals;

TEST_F(ViewerScheduleTest, DrawsNothingBeforeAView) {
  schedule_.join(kAnn, {});
  schedule_.contentChanged();
  EXPECT_FALSE(next());
}

TEST_F(ViewerScheduleTest, DrawsOnceUntilSomethingChanges) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(), start_);
  const auto job = next();
  ASSERT_TRUE(job);
  EXPECT_EQ(share(job).viewer, kAnn);
  EXPECT_EQ(share(job).frameId, 1U);
  EXPECT_EQ(share(job).reflectsSequence, 1U);
  EXPECT_FALSE(next(1s));
  schedule_.contentChanged();
  EXPECT_TRUE(next(1s));
}

TEST_F(ViewerScheduleTest, OnlyTheNewestCameraIsDrawn) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(), start_);
  core::Camera last;
  for (std::uint64_t sequence = 2; sequence <= 9; ++sequence) {
    last.eye.x() = static_cast<float>(sequence);
    schedule_.setCamera(kAnn, sequence, last, start_);
  }
  const auto job = next();
  ASSERT_TRUE(job);
  EXPECT_EQ(share(job).reflectsSequence, 9U);
  EXPECT_EQ(job->camera, last);
  EXPECT_FALSE(next(1s));
}

TEST_F(ViewerScheduleTest, KeepsAtMostTheWindowUnderWay) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(), start_);
  int drawn = 0;
  for (auto at = 0ms; at < 1s; at += 10ms) {
    schedule_.contentChanged();
    if (next(at)) ++drawn;
  }
  EXPECT_EQ(drawn, 2);
  schedule_.acknowledge(kAnn, 1, start_);
  EXPECT_TRUE(next(2s));
  EXPECT_FALSE(next(3s));
}

TEST_F(ViewerScheduleTest, AcknowledgingAFrameCoversEarlierOnes) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(), start_);
  next(0ms);
  schedule_.contentChanged();
  next(10ms);
  schedule_.acknowledge(kAnn, 2, start_);
  schedule_.acknowledge(kAnn, 1, start_);  // late, and without effect
  for (int frame = 0; frame < 2; ++frame) {
    schedule_.contentChanged();
    EXPECT_TRUE(next(1s + frame * 10ms)) << frame;
  }
}

TEST_F(ViewerScheduleTest, AcknowledgingWhatWasNeverDrawnOpensNothing) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(), start_);
  schedule_.acknowledge(kAnn, 1000, start_);
  int drawn = 0;
  for (auto at = 0ms; at < 1s; at += 10ms) {
    schedule_.contentChanged();
    if (next(at)) ++drawn;
  }
  EXPECT_EQ(drawn, 2);
}

TEST_F(ViewerScheduleTest, StaysBelowTheRateAsked) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(10), start_);
  int drawn = 0;
  for (auto at = 0ms; at < 1s; at += 5ms) {
    schedule_.contentChanged();
    if (const auto job = next(at)) {
      ++drawn;
      finish(*job, at);
    }
  }
  EXPECT_EQ(drawn, 10);
}

TEST_F(ViewerScheduleTest, TellsWhenTheRateAllowsTheNext) {
  schedule_.join(kAnn, {});
  EXPECT_FALSE(schedule_.nextDue(start_));
  schedule_.setView(kAnn, 1, view(10), start_);
  next();
  EXPECT_FALSE(schedule_.nextDue(start_)) << "nothing changed";
  schedule_.contentChanged();
  EXPECT_EQ(schedule_.nextDue(start_), start_ + 100ms);
  EXPECT_FALSE(next(99ms));
  EXPECT_TRUE(next(100ms));
}

TEST_F(ViewerScheduleTest, ServesViewersInTurn) {
  for (const core::ViewerId viewer : {kAnn, kBob}) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, view(), start_);
  }
  int annsTurns = 0;
  for (int k = 0; k < 100; ++k) {
    schedule_.contentChanged();
    const auto job = next(k * 10ms);
    ASSERT_TRUE(job);
    annsTurns += share(job).viewer == kAnn ? 1 : 0;
    finish(*job, k * 10ms);
  }
  EXPECT_EQ(annsTurns, 50);
}

TEST_F(ViewerScheduleTest, AViewerThatNeverAcknowledgesDelaysNobody) {
  for (const core::ViewerId viewer : {kAnn, kBob}) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, view(), start_);
  }
  int bobs = 0;
  for (int k = 0; k < 50; ++k) {
    schedule_.contentChanged();
    for (auto job = next(k * 10ms); job; job = next(k * 10ms)) {
      if (share(job).viewer != kBob) continue;
      ++bobs;
      finish(*job, k * 10ms);
    }
  }
  EXPECT_EQ(bobs, 50);
}

TEST_F(ViewerScheduleTest, SnapshotsStandOutsideTheWindow) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(), start_);
  next(0ms);
  schedule_.contentChanged();
  next(10ms);
  core::Camera aside;
  aside.eye.x() = 7;
  EXPECT_TRUE(schedule_.requestSnapshot(kAnn, 5, {100, 50}, aside));
  EXPECT_FALSE(schedule_.requestSnapshot(kAnn, 6, {100, 50}, aside)) << "one at a time";
  const auto job = next(20ms);
  ASSERT_TRUE(job);
  EXPECT_EQ(share(job).inReplyTo, 5U);
  EXPECT_EQ(job->size, (core::ImageSize{100, 50}));
  EXPECT_EQ(job->encodings.at(0).settings.codec, core::Codec::Png);
  EXPECT_EQ(job->camera, aside);
}

TEST_F(ViewerScheduleTest, StartCameraMovesOnlyThoseWithoutTheirOwn) {
  core::Camera own;
  own.eye.x() = 7;
  for (const core::ViewerId viewer : {kAnn, kBob}) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, view(), start_);
  }
  schedule_.setCamera(kAnn, 2, own, start_);
  core::Camera start;
  start.eye.x() = -3;
  schedule_.setStartCamera(start);
  EXPECT_EQ(next(0ms)->camera, own);
  EXPECT_EQ(next(1ms)->camera, start);
}

TEST_F(ViewerScheduleTest, ViewersThatLeftAreForgotten) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, view(), start_);
  schedule_.leave(kAnn);
  schedule_.setCamera(kAnn, 2, {}, start_);
  EXPECT_FALSE(next());
  EXPECT_FALSE(schedule_.requestSnapshot(kAnn, 3, {1, 1}, std::nullopt));
  EXPECT_EQ(schedule_.size(), 0U);
}

TEST_F(ViewerScheduleTest, ALosslessStillComesWhenAllHasBeenAtRest) {
  schedule_.join(kAnn, {});
  stream::View asked = view();
  asked.stills = true;
  schedule_.setView(kAnn, 1, asked, start_);
  const auto job = next();
  EXPECT_FALSE(next(400ms)) << "the last frame is not drawn yet";
  finish(*job, 10ms);
  EXPECT_EQ(schedule_.nextDue(start_ + 10ms), start_ + 300ms);
  EXPECT_FALSE(next(299ms));
  const auto still = next(300ms);
  ASSERT_TRUE(still);
  EXPECT_TRUE(still->still);
  EXPECT_EQ(still->encodings.at(0).settings.codec, core::Codec::Png);
  EXPECT_FALSE(still->encodings.at(0).stream);
  finish(*still, 310ms);
  EXPECT_FALSE(next(2s)) << "once";
  EXPECT_FALSE(schedule_.nextDue(start_ + 2s));
}

TEST_F(ViewerScheduleTest, NoStillWhileThingsMove) {
  schedule_.join(kAnn, {});
  stream::View asked = view();
  asked.stills = true;
  schedule_.setView(kAnn, 1, asked, start_);
  for (auto at = 0ms; at < 2s; at += 50ms) {
    schedule_.contentChanged();
    const auto job = next(at);
    ASSERT_TRUE(job);
    EXPECT_FALSE(job->still);
    finish(*job, at);
  }
}

TEST_F(ViewerScheduleTest, TimeToDrawIsSharedFairlyWhateverThePicturesCost) {
  for (const core::ViewerId viewer : {kAnn, kBob}) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, view(), start_);
  }
  std::map<core::ViewerId, double> spent;
  auto at = 0ms;
  for (int k = 0; k < 300; ++k) {
    schedule_.contentChanged();
    const auto job = schedule_.next(start_ + at);
    ASSERT_TRUE(job);
    // Ann's pictures are ten times as large.
    const auto cost = job->owner == kAnn ? 100ms : 10ms;
    at += cost;
    schedule_.drawn(*job, std::chrono::duration<double>(cost).count());
    schedule_.encoded(job->owner);
    spent[job->owner] += std::chrono::duration<double>(cost).count();
    finish(*job, at);
  }
  EXPECT_NEAR(spent[kAnn] / spent[kBob], 1, 0.1);
}

}  // namespace
}  // namespace sluice::app
