#include "sluice/app/rate_control.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <vector>

#include <gtest/gtest.h>

namespace sluice::app {
namespace {

using namespace std::chrono_literals;
using Seconds = std::chrono::duration<double>;

/// A link that carries so many bytes a second, one frame after the other, and takes its time there and back; behind it
/// a viewer that acknowledges at once. Frames are as large as their size and quality make them.
class Link {
 public:
  Link(double bytesPerSecond, double roundTrip) : bytesPerSecond_(bytesPerSecond), roundTrip_(roundTrip) {}

  void setCapacity(double bytesPerSecond) { bytesPerSecond_ = bytesPerSecond; }

  void setRoundTrip(double seconds) { roundTrip_ = seconds; }

  struct Run {
    double longestDelay = 0;     ///< From sending a frame to its acknowledgement, s, in the run's second half.
    double startDelay = 0;       ///< The longest in its first half.
    double framesPerSecond = 0;  ///< In its second half.
    double bytesPerSecond = 0;
  };

  /// Plays a viewer that is sent a frame whenever its window has room and its rate allows.
  Run play(RateController& rate, const stream::View& view, double seconds) {
    Run run;
    const double end = now_ + seconds;
    const double half = now_ + seconds / 2;
    double nextFrame = now_;
    for (; now_ < end; now_ += 0.001) {
      for (; !underWay_.empty() && underWay_.front().arrives <= now_; underWay_.pop_front()) {
        rate.acknowledged(underWay_.front().id, at(now_));
        double& longest = now_ < half ? run.startDelay : run.longestDelay;
        longest = std::max(longest, underWay_.front().arrives - underWay_.front().sent);
        if (now_ < half) continue;
        run.framesPerSecond += 2 / seconds;
        run.bytesPerSecond += 2 / seconds * underWay_.front().bytes;
      }
      const RateTarget& target = rate.target();
      if (now_ < nextFrame || underWay_.size() >= target.window) continue;
      nextFrame = now_ + 1 / target.framesPerSecond;
      send(rate, view, target);
    }
    return run;
  }

 private:
  struct Frame {
    std::uint64_t id;
    double sent;
    double arrives;
    double bytes;
  };

  RateController::Clock::time_point at(double seconds) const {
    return start_ + std::chrono::duration_cast<RateController::Clock::duration>(Seconds(seconds));
  }

  void send(RateController& rate, const stream::View& view, const RateTarget& target) {
    const core::ImageSize size{static_cast<int>(view.size.width * target.scale),
                               static_cast<int>(view.size.height * target.scale)};
    // 0.12 bytes a pixel at quality 85, a third of that at 55.
    const double bytes = 0.12 * size.width * size.height * std::pow(2.0, (target.quality - 85) / 19.0);
    free_ = std::max(free_, now_) + bytes / bytesPerSecond_;
    underWay_.push_back({++lastId_, now_, free_ + roundTrip_, bytes});
    rate.sent({.frameId = lastId_, .bytes = static_cast<std::size_t>(bytes), .size = size, .quality = target.quality},
              at(now_));
  }

  const RateController::Clock::time_point start_ = RateController::Clock::now();
  double bytesPerSecond_;
  double roundTrip_;
  double now_ = 0;
  double free_ = 0;
  std::uint64_t lastId_ = 0;
  std::deque<Frame> underWay_;
};

stream::View view() { return {.size = {1280, 720}, .maxRate = 30}; }

RateController controller() {
  RateController rate(8);
  rate.setView(view());
  return rate;
}

// 110 KB a frame, 3.3 MB/s at the full rate.
TEST(RateControl, AFastLinkGetsTheBest) {
  RateController rate = controller();
  Link link(50e6, 0.002);
  const Link::Run run = link.play(rate, view(), 5);
  EXPECT_EQ(rate.target().quality, 85);
  EXPECT_EQ(rate.target().scale, 1);
  EXPECT_TRUE(std::isinf(rate.budget()));
  EXPECT_NEAR(run.framesPerSecond, 30, 1);
}

TEST(RateControl, AFarFastLinkKeepsItsRate) {
  RateController rate = controller();
  Link link(50e6, 0.15);
  const Link::Run run = link.play(rate, view(), 5);
  EXPECT_EQ(rate.target().quality, 85);
  EXPECT_GT(run.framesPerSecond, 28) << "with the window " << rate.target().window;
}

TEST(RateControl, HalfTheLinkCostsQualityAlone) {
  RateController rate = controller();
  Link link(1.6e6, 0.02);
  const Link::Run run = link.play(rate, view(), 20);
  EXPECT_LT(rate.target().quality, 80);
  EXPECT_GE(rate.target().quality, 40);
  EXPECT_EQ(rate.target().scale, 1);
  EXPECT_GT(run.framesPerSecond, 25);
  EXPECT_GT(run.bytesPerSecond, 0.5 * 1.6e6) << "much of the link is left unused";
}

TEST(RateControl, ATenthOfTheLinkCostsSizeTooAndDelayStaysBelowFourFrames) {
  RateController rate = controller();
  Link link(0.33e6, 0.02);
  const Link::Run run = link.play(rate, view(), 20);
  EXPECT_LT(rate.target().scale, 1);
  EXPECT_GT(run.framesPerSecond, 20);
  EXPECT_LT(run.longestDelay, 4.0 / 30 + 0.02);
}

TEST(RateControl, ANarrowLinkIsNotTakenForAFarOneWhenItBegins) {
  RateController rate = controller();
  Link link(0.33e6, 0.02);
  const Link::Run run = link.play(rate, view(), 20);
  // Two of the first, full-sized frames, one behind the other.
  EXPECT_LT(run.startDelay, 2 * 0.12 * 1280 * 720 / 0.33e6 + 0.03);
}

TEST(RateControl, AHundredthOfTheLinkCostsRateAtLast) {
  RateController rate = controller();
  Link link(0.01e6, 0.02);
  const Link::Run run = link.play(rate, view(), 60);
  EXPECT_EQ(rate.target().scale, 0.25);
  EXPECT_LT(rate.target().framesPerSecond, 30);
  EXPECT_GT(run.framesPerSecond, 1);
  EXPECT_LT(run.longestDelay, 1.5);
}

TEST(RateControl, RecoversWhenTheLinkDoes) {
  RateController rate = controller();
  Link link(0.33e6, 0.02);
  link.play(rate, view(), 10);
  ASSERT_LT(rate.target().scale, 1);
  link.setCapacity(50e6);
  link.play(rate, view(), 40);
  EXPECT_EQ(rate.target().quality, 85);
  EXPECT_EQ(rate.target().scale, 1);
}

// A viewer that starts up, or whose machine is busy, is late with every frame, small or large.
TEST(RateControl, ASlowStartIsForgottenWithinSeconds) {
  RateController rate = controller();
  Link link(50e6, 7);
  link.play(rate, view(), 15);
  link.setRoundTrip(0.02);
  link.play(rate, view(), 12);
  EXPECT_EQ(rate.target().quality, 85);
  EXPECT_EQ(rate.target().scale, 1);
}

TEST(RateControl, AViewerThatIsSlowByItselfKeepsItsPictures) {
  RateController rate = controller();
  Link link(50e6, 0.6);
  const Link::Run run = link.play(rate, view(), 30);
  EXPECT_EQ(rate.target().scale, 1);
  EXPECT_GE(rate.target().quality, 70);
  EXPECT_GT(run.framesPerSecond, 3);
}

TEST(RateControl, FixedQualityIsNeverTouched) {
  stream::View fixed = view();
  fixed.mode = v1::FIXED_QUALITY;
  RateController rate(8);
  rate.setView(fixed);
  Link link(0.33e6, 0.02);
  const Link::Run run = link.play(rate, fixed, 10);
  EXPECT_EQ(rate.target().quality, 85);
  EXPECT_EQ(rate.target().scale, 1);
  EXPECT_EQ(rate.target().window, 2U);
  EXPECT_NEAR(run.framesPerSecond, 0.33e6 / 110592, 0.4) << "what the link carries of full frames";
}

TEST(RateControl, SmallChangesOfTheLinkDoNotChangeTheEncoderEachTime) {
  RateController rate = controller();
  Link link(1.6e6, 0.02);
  link.play(rate, view(), 10);
  int changes = 0;
  int quality = rate.target().quality;
  for (int k = 0; k < 100; ++k) {
    link.setCapacity(1.6e6 * (1 + 0.05 * std::sin(k)));
    link.play(rate, view(), 0.1);
    changes += rate.target().quality != quality ? 1 : 0;
    quality = rate.target().quality;
  }
  EXPECT_LE(changes, 15) << "in ten seconds";
}

}  // namespace
}  // namespace sluice::app
