// How many pictures of one viewer ViewerSchedule lets be drawn and not yet encoded.
#include <chrono>

#include <gtest/gtest.h>

#include "sluice/app/viewer_schedule.h"

namespace sluice::app {
namespace {

using namespace std::chrono_literals;

constexpr core::ViewerId kAnn = 1;
constexpr core::ViewerId kBob = 2;

class PipelineDepthTest : public testing::TestWithParam<int> {
 protected:
  void join(core::ViewerId viewer) {
    schedule_.join(viewer, {});
    schedule_.setView(viewer, 1, {.size = {640, 480}, .maxRate = 1000, .stills = false}, start_);
  }

  /// Pictures that are begun while the content changes ten times, none encoded and all acknowledged.
  int begunUnencoded() {
    int begun = 0;
    for (int k = 0; k < 10; ++k) {
      schedule_.contentChanged();
      const auto job = schedule_.next(start_ + k * 10ms);
      if (!job) continue;
      ++begun;
      const core::Delivery& delivery = job->encodings.at(0).deliveries.at(0);
      schedule_.acknowledge(delivery.viewer, delivery.frameId, start_ + k * 10ms);
    }
    return begun;
  }

  const ViewerSchedule::Clock::time_point start_ = ViewerSchedule::Clock::now();
  ViewerSchedule schedule_{2};
};

TEST_P(PipelineDepthTest, BoundsWhatIsBegunAndNotEncoded) {
  schedule_.setPipelineDepth(GetParam());
  join(kAnn);
  EXPECT_EQ(begunUnencoded(), GetParam());
  EXPECT_FALSE(schedule_.next(start_ + 1s));
  schedule_.encoded(kAnn);
  EXPECT_TRUE(schedule_.next(start_ + 1s));
}

TEST_P(PipelineDepthTest, CountsForEachViewerAlone) {
  schedule_.setPipelineDepth(GetParam());
  join(kAnn);
  join(kBob);
  EXPECT_EQ(begunUnencoded(), 2 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Depths, PipelineDepthTest, testing::Values(1, 2, 3), testing::PrintToStringParamName());

TEST(PipelineDepth, IsTwoUnlessSet) {
  ViewerSchedule schedule(2);
  const auto start = ViewerSchedule::Clock::now();
  schedule.join(kAnn, {});
  schedule.setView(kAnn, 1, {.size = {640, 480}, .maxRate = 1000, .stills = false}, start);
  EXPECT_TRUE(schedule.next(start));
  schedule.contentChanged();
  EXPECT_TRUE(schedule.next(start + 10ms));
  schedule.contentChanged();
  EXPECT_FALSE(schedule.next(start + 20ms));
}

}  // namespace
}  // namespace sluice::app
