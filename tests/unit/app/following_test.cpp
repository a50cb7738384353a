// Viewers that follow another: one picture and one encoding for all, and nobody is delayed by the slowest.

#include <chrono>
#include <map>

#include <gtest/gtest.h>

#include "sluice/core/input_error.h"
#include "viewer_schedule_fixture.h"

namespace sluice::app {
namespace {

using namespace std::chrono_literals;

/// Viewers that follow Ann, with video.
class FollowingTest : public ViewerScheduleTest {
 protected:
  static constexpr core::ViewerId kFollowers = 16;

  static stream::View video(core::ViewerId follow = 0) {
    stream::View asked = view();
    asked.codecs = {core::Codec::H264, core::Codec::Jpeg};
    asked.follow = follow;
    return asked;
  }

  void joinAll() {
    for (core::ViewerId viewer = kAnn; viewer <= kFollowers; ++viewer) {
      schedule_.join(viewer, {});
      schedule_.setView(viewer, 1, video(viewer == kAnn ? 0 : kAnn), start_);
    }
  }
};

TEST_F(FollowingTest, OnePictureIsEncodedOnceForAll) {
  joinAll();
  const auto job = next();
  ASSERT_TRUE(job);
  ASSERT_EQ(job->encodings.size(), 1U);
  EXPECT_EQ(job->encodings[0].deliveries.size(), kFollowers);
  EXPECT_TRUE(job->encodings[0].keyframe);
  EXPECT_FALSE(next()) << "nobody is left to serve";
}

TEST_F(FollowingTest, FollowersSeeWithTheLeadersCameraInItsSize) {
  schedule_.join(kAnn, {});
  schedule_.join(kBob, {});
  stream::View large = view();
  large.size = {800, 600};
  schedule_.setView(kAnn, 1, large, start_);
  stream::View following = view();
  following.follow = kAnn;
  schedule_.setView(kBob, 1, following, start_);
  finish(*next(), 0ms);
  core::Camera camera;
  camera.eye.x() = 9;
  schedule_.setCamera(kAnn, 2, camera, start_);
  const auto job = next(10ms);
  ASSERT_TRUE(job);
  EXPECT_EQ(job->owner, kAnn);
  EXPECT_EQ(job->camera, camera);
  EXPECT_EQ(job->size, (core::ImageSize{800, 600}));
  EXPECT_EQ(job->encodings.at(0).deliveries.size(), 2U);
}

TEST_F(FollowingTest, OthersCodecsGetAnEncodingOfTheSamePicture) {
  schedule_.join(kAnn, {});
  schedule_.join(kBob, {});
  schedule_.setView(kAnn, 1, video(), start_);
  stream::View jpeg = view();
  jpeg.follow = kAnn;
  schedule_.setView(kBob, 1, jpeg, start_);
  const auto job = next();
  ASSERT_TRUE(job);
  EXPECT_EQ(job->encodings.size(), 2U);
}

TEST_F(FollowingTest, ASlowFollowerIsPartedFromTheOthers) {
  joinAll();
  const core::ViewerId slow = 3;
  std::map<core::ViewerId, int> frames;
  bool apart = false;
  for (auto at = 0ms; at < 3s; at += 10ms) {
    schedule_.contentChanged();
    for (auto job = next(at); job; job = next(at)) {
      for (const ViewerSchedule::Encoding& encoding : job->encodings) {
        apart = apart || encoding.stream->apart == slow;
        for (const core::Delivery& delivery : encoding.deliveries) {
          ++frames[delivery.viewer];
          if (delivery.viewer != slow) schedule_.acknowledge(delivery.viewer, delivery.frameId, start_ + at);
        }
      }
    }
  }
  EXPECT_EQ(frames[slow], 2) << "the window";
  EXPECT_GT(frames[kAnn], 280) << "of 300";
  schedule_.acknowledge(slow, 2, start_ + 3s);
  schedule_.contentChanged();
  for (auto job = next(3s); job; job = next(3s)) {
    for (const ViewerSchedule::Encoding& encoding : job->encodings) {
      if (encoding.stream->apart != slow) continue;
      apart = true;
      EXPECT_TRUE(encoding.keyframe) << "deltas were left out";
    }
  }
  EXPECT_TRUE(apart);
}

TEST_F(FollowingTest, NobodyFollowsInCircles) {
  schedule_.join(kAnn, {});
  schedule_.join(kBob, {});
  schedule_.setView(kAnn, 1, video(), start_);
  schedule_.setView(kBob, 1, video(kAnn), start_);
  EXPECT_THROW(schedule_.setView(kAnn, 2, video(kBob), start_), core::InputError);
  EXPECT_THROW(schedule_.setView(kAnn, 2, video(77), start_), core::InputError);
}

TEST_F(FollowingTest, FollowersOfOneWhoLeavesSeeWithTheirOwnEyes) {
  schedule_.join(kAnn, {});
  schedule_.join(kBob, {});
  schedule_.setView(kAnn, 1, video(), start_);
  schedule_.setView(kBob, 1, video(kAnn), start_);
  finish(*next(), 0ms);
  schedule_.leave(kAnn);
  const auto job = next(10ms);
  ASSERT_TRUE(job);
  EXPECT_EQ(job->owner, kBob);
}

TEST_F(FollowingTest, AKeyframeComesAfterAFrameThatWasNotTaken) {
  schedule_.join(kAnn, {});
  schedule_.setView(kAnn, 1, video(), start_);
  const auto first = next();
  schedule_.sent(first->encodings[0].deliveries[0], {}, false, start_);
  const auto again = next(10ms);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->encodings.at(0).keyframe);
  finish(*again, 10ms);
  schedule_.contentChanged();
  EXPECT_FALSE(next(20ms)->encodings.at(0).keyframe);
  schedule_.requestKeyframe(kAnn);
  EXPECT_TRUE(next(30ms)->encodings.at(0).keyframe);
}

}  // namespace
}  // namespace sluice::app
