#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "sluice/core/camera.h"
#include "sluice/stream/backend.h"

namespace sluice::app {

/// How the next frame for a viewer is to be made.
struct RateTarget {
  int quality = 85;  ///< 1..100.
  double scale = 1;  ///< Of the picture's edges, ≤ 1.
  double framesPerSecond = 60;
  int kilobitsPerSecond = 0;  ///< Cap for video codecs; 0: none.
  std::uint32_t window = 2;   ///< Frames that may be under way.
};

/// Finds what a viewer's link and machine can take, from the acknowledgements of its frames alone. A frame that comes
/// back later than the quickest ones of late have stands in a queue: then the link is full, the bytes that came through
/// tell what it carries, and the next frames get fewer. Gives up quality first, then size, then rate, and tries for
/// more, little by little, once the queue is gone. No clock, lock or thread of its own.
class RateController {
 public:
  using Clock = std::chrono::steady_clock;

  /// `maxWindow` frames may be under way at most.
  explicit RateController(std::uint32_t maxWindow = 2) : maxWindow_(maxWindow) {}

  /// What the viewer asks for: the best that it is given. Keeps what is known of the link.
  void setView(const stream::View& view);

  /// How long it takes to draw a frame for this viewer, s: frames come no faster than that.
  void setDrawSeconds(double seconds);

  struct Sent {
    std::uint64_t frameId = 0;
    std::size_t bytes = 0;
    core::ImageSize size;
    int quality = 0;       ///< 0 for a lossless picture, which says nothing of the others.
    bool keyframe = true;  ///< Of a video codec: larger than those that follow.
  };
  void sent(const Sent& frame, Clock::time_point now);

  /// This frame and all before it have been drawn.
  void acknowledged(std::uint64_t frameId, Clock::time_point now);

  const RateTarget& target() const { return target_; }

  /// What the link is believed to carry, bytes/s; infinite while it was never full.
  double budget() const { return budget_; }

 private:
  struct UnderWay {
    std::uint64_t frameId;
    std::size_t bytes;
    Clock::time_point sent;
    std::uint32_t ahead;  ///< Frames that were under way when it was sent.
  };
  struct Arrival {
    Clock::time_point when;
    std::size_t bytes;
    double delay;
    std::uint32_t ahead;
  };

  double quickest();
  double recentDelay() const;
  double deliveredRate() const;
  double frameRate() const;
  double bytesAt(int quality, double scale) const;
  void judge(Clock::time_point now);
  /// What a frame takes there and back with no other under way, s; none where no such frame came of late.
  std::optional<double> roundTrip() const;
  /// Lets frames enough be under way to fill that time, but not a queue.
  void fitWindow(bool full, Clock::time_point now);
  void aim(Clock::time_point now);

  std::uint32_t maxWindow_;
  stream::View view_;
  RateTarget target_;
  std::deque<UnderWay> underWay_;
  std::deque<Arrival> arrivals_;
  double drawSeconds_ = 0;
  double ofSmallFrames_ = 0;  ///< What small frames took last, s; 0 while there were none.
  double bytesPerPixel_ = 0;  ///< At quality 85; 0 before the first frame.
  double budget_ = std::numeric_limits<double>::infinity();
  double limit_ = std::numeric_limits<double>::infinity();  ///< What the link carried when it was last full.
  std::uint64_t acknowledgedId_ = 0;
  std::uint64_t grownAt_ = 0;  ///< The last frame that was under way when the window grew.
  Clock::time_point lastFull_{};
  Clock::time_point lastChange_{};
  Clock::time_point lastAim_{};
};

}  // namespace sluice::app
