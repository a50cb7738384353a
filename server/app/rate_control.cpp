#include "sluice/app/rate_control.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sluice::app {

namespace {

using Seconds = std::chrono::duration<double>;

double secondsBetween(RateController::Clock::time_point from, RateController::Clock::time_point to) {
  return Seconds(to - from).count();
}

/// Arrivals that the quickest is sought among, and those that a rate is measured over.
constexpr double kMemorySeconds = 10;
constexpr double kRateSeconds = 1;

/// A link slower than this to begin with is taken for a full one.
constexpr double kLongestRoundTrip = 0.25;

/// Time in the queue that tells a full link, and one that has room.
constexpr double kFull = 0.03;
constexpr double kRoom = 0.015;
constexpr double kUnsteady = 0.3;

/// Frames so much smaller than the largest tell what a frame takes however small it is.
constexpr double kSmall = 0.3;

/// The share that is taken of the measured rate, and steps up from there: slow ones near the rate at which the link was
/// last full, quick ones below and beyond it.
constexpr double kBackOff = 0.85;
constexpr double kNearBelow = 0.7;
constexpr double kNearAbove = 1.3;
constexpr double kQuickRise = 2;
constexpr double kRise = 1.12;
constexpr double kRiseSeconds = 0.5;
constexpr double kBetterSeconds = 1;
/// A budget so many times over what the best quality needs is none.
constexpr double kPlenty = 4;

/// Bytes of a picture grow by this per point of quality, for JPEG and video alike (a doubling in 19 points).
constexpr double kBytesPerQuality = 0.037;
constexpr int kReference = 85;

/// Where quality ends and size begins to fall; pictures return to a larger size from a little above.
constexpr int kLowestQuality = 40;
constexpr int kReturnQuality = 55;
constexpr std::array<double, 5> kScales{1, 0.75, 0.5, 0.375, 0.25};
constexpr double kLowestRate = 1;

/// Changes smaller than this are not worth a new encoder.
constexpr int kQualityStep = 4;

/// What a fifth of the delays stay below: the quickest, but for chance.
double lowest(std::vector<double>& delays) {
  const auto fifth = delays.begin() + static_cast<std::ptrdiff_t>(delays.size() / 5);
  std::nth_element(delays.begin(), fifth, delays.end());
  return *fifth;
}

}  // namespace

void RateController::setView(const stream::View& view) {
  view_ = view;
  lastAim_ = {};
  target_ = {.quality = view.quality,
             .scale = view.mode == v1::AUTOMATIC ? target_.scale : 1,
             .framesPerSecond = view.maxRate,
             .kilobitsPerSecond = view.kilobitsPerSecond,
             .window = std::min<std::uint32_t>(2, maxWindow_)};
  if (view.mode == v1::AUTOMATIC && std::isfinite(budget_)) aim({});
}

void RateController::setDrawSeconds(double seconds) {
  drawSeconds_ = drawSeconds_ == 0 ? seconds : 0.8 * drawSeconds_ + 0.2 * seconds;
}

void RateController::sent(const Sent& frame, Clock::time_point now) {
  underWay_.push_back({frame.frameId, frame.bytes, now, static_cast<std::uint32_t>(underWay_.size())});
  const double pixels = static_cast<double>(frame.size.width) * frame.size.height;
  if (frame.quality == 0 || (frame.keyframe && core::isVideo(view_.codecs.front()) && bytesPerPixel_ != 0)) return;
  const double measured =
      static_cast<double>(frame.bytes) / pixels * std::exp(-kBytesPerQuality * (frame.quality - kReference));
  bytesPerPixel_ = bytesPerPixel_ == 0 ? measured : 0.7 * bytesPerPixel_ + 0.3 * measured;
}

void RateController::acknowledged(std::uint64_t frameId, Clock::time_point now) {
  for (; !underWay_.empty() && underWay_.front().frameId <= frameId; underWay_.pop_front()) {
    const double delay = secondsBetween(underWay_.front().sent, now);
    arrivals_.push_back({now, underWay_.front().bytes, delay, underWay_.front().ahead});
    acknowledgedId_ = underWay_.front().frameId;
  }
  while (!arrivals_.empty() && secondsBetween(arrivals_.front().when, now) > kMemorySeconds) arrivals_.pop_front();
  if (arrivals_.empty()) return;
  judge(now);
  if (view_.mode == v1::AUTOMATIC) aim(now);
}

double RateController::quickest() {
  std::size_t largest = 0;
  for (const Arrival& arrival : arrivals_) largest = std::max(largest, arrival.bytes);
  std::vector<double> all;
  std::vector<double> small;
  for (const Arrival& arrival : arrivals_) {
    all.push_back(arrival.delay);
    if (static_cast<double>(arrival.bytes) < kSmall * static_cast<double>(largest)) small.push_back(arrival.delay);
  }
  // A viewer that is far or busy takes its time with small frames too. As long as there were none, a slow frame tells
  // of the link.
  if (!small.empty()) ofSmallFrames_ = lowest(small);
  return std::min(lowest(all), std::max(ofSmallFrames_, kLongestRoundTrip));
}

double RateController::recentDelay() const {
  const std::size_t count = arrivals_.size();
  if (count < 3) return arrivals_.back().delay;
  const double a = arrivals_[count - 3].delay;
  const double b = arrivals_[count - 2].delay;
  const double c = arrivals_[count - 1].delay;
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

double RateController::deliveredRate() const {
  const Arrival& last = arrivals_.back();
  double bytes = 0;
  Clock::time_point first = last.when - std::chrono::duration_cast<Clock::duration>(Seconds(last.delay));
  for (auto arrival = arrivals_.rbegin(); arrival != arrivals_.rend(); ++arrival) {
    const double age = secondsBetween(arrival->when, last.when);
    // Of several frames the first only marks the time from which the others came.
    if (age > kRateSeconds) {
      first = arrival->when;
      break;
    }
    bytes += static_cast<double>(arrival->bytes);
    first = std::min(first, arrival->when - std::chrono::duration_cast<Clock::duration>(Seconds(arrival->delay)));
  }
  return bytes / std::max(secondsBetween(first, last.when), 1e-3);
}

void RateController::judge(Clock::time_point now) {
  const double delay = recentDelay();
  const double base = quickest();
  const double queued = delay - base;
  // Whoever is slow by itself is unsteady as well.
  const bool full = queued > kFull + kUnsteady * base;
  if (full && secondsBetween(lastChange_, now) > std::max(delay, 0.2)) {
    limit_ = std::min(budget_, deliveredRate());
    budget_ = kBackOff * limit_;
    lastChange_ = now;
  } else if (queued < kRoom && std::isfinite(budget_) && secondsBetween(lastChange_, now) > kRiseSeconds) {
    const bool near = budget_ > kNearBelow * limit_ && budget_ < kNearAbove * limit_;
    budget_ *= near ? kRise : kQuickRise;
    lastChange_ = now;
    if (budget_ > kPlenty * bytesAt(view_.quality, 1) * frameRate()) {
      budget_ = std::numeric_limits<double>::infinity();
    }
  }
  fitWindow(full, now);
}

std::optional<double> RateController::roundTrip() const {
  std::optional<double> shortest;
  for (const Arrival& arrival : arrivals_) {
    if (arrival.ahead != 0 || arrival.when <= lastFull_) continue;
    shortest = std::min(arrival.delay, shortest.value_or(arrival.delay));
  }
  return shortest;
}

void RateController::fitWindow(bool full, Clock::time_point now) {
  const std::uint32_t least = std::min(2U, maxWindow_);
  if (full) {
    lastFull_ = now;
    target_.window = least;
    return;
  }
  const std::optional<double> alone = roundTrip();
  if (!alone) {
    // One frame by itself tells how long the way is without a queue.
    if (target_.window > least || lastFull_ != Clock::time_point{}) target_.window = 1;
    return;
  }
  const auto pipe = static_cast<std::uint32_t>(std::ceil(*alone * frameRate()));
  const std::uint32_t enough = std::clamp(pipe + 1, least, maxWindow_);
  if (enough <= target_.window || target_.window < least) {
    target_.window = std::min(enough, std::max(target_.window, least));
    return;
  }
  // In a narrow link each frame more under way makes the next ones slower, in a far one it does not: one is added at a
  // time, and its effect awaited.
  const Arrival& last = arrivals_.back();
  const bool windowUsed = last.ahead + 1 >= target_.window && acknowledgedId_ > grownAt_;
  if (!windowUsed || last.delay > *alone * (1 + kUnsteady) + kRoom) return;
  ++target_.window;
  grownAt_ = underWay_.empty() ? acknowledgedId_ : underWay_.back().frameId;
}

double RateController::frameRate() const {
  return drawSeconds_ > 0 ? std::min(view_.maxRate, 1 / drawSeconds_) : view_.maxRate;
}

double RateController::bytesAt(int quality, double scale) const {
  const double pixels = static_cast<double>(view_.size.width) * view_.size.height * scale * scale;
  return bytesPerPixel_ * pixels * std::exp(kBytesPerQuality * (quality - kReference));
}

void RateController::aim(Clock::time_point now) {
  RateTarget wanted = target_;
  wanted.quality = view_.quality;
  wanted.scale = 1;
  wanted.framesPerSecond = view_.maxRate;
  wanted.kilobitsPerSecond = 0;
  if (std::isfinite(budget_) && bytesPerPixel_ > 0) {
    const double perFrame = budget_ / frameRate();
    wanted.kilobitsPerSecond = std::max(static_cast<int>(budget_ * 8 / 1000), 50);
    const int lowest = std::min(kLowestQuality, view_.quality);
    for (const double scale : kScales) {
      const double quality = kReference + std::log(perFrame / bytesAt(kReference, scale)) / kBytesPerQuality;
      wanted.scale = scale;
      wanted.quality = std::clamp(static_cast<int>(quality), lowest, view_.quality);
      const int enough = scale > target_.scale ? std::min(kReturnQuality, view_.quality) : lowest;
      if (quality >= enough) break;
    }
    const double bytes = bytesAt(wanted.quality, wanted.scale);
    wanted.framesPerSecond = std::clamp(budget_ / bytes, std::min(kLowestRate, view_.maxRate), view_.maxRate);
  }

  // Down at once, up now and then: every change may cost a keyframe.
  const bool less = wanted.scale < target_.scale || wanted.quality <= target_.quality - kQualityStep;
  const bool more = wanted.scale > target_.scale || wanted.quality >= target_.quality + kQualityStep ||
                    (wanted.quality == view_.quality && target_.quality != view_.quality);
  if (less || (more && secondsBetween(lastAim_, now) > kBetterSeconds)) {
    target_.quality = wanted.quality;
    target_.scale = wanted.scale;
    lastAim_ = now;
  }
  target_.framesPerSecond = wanted.framesPerSecond;
  target_.kilobitsPerSecond = wanted.kilobitsPerSecond;
}

}  // namespace sluice::app
