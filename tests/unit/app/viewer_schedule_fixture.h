#pragma once

#include <chrono>
#include <optional>

#include <gtest/gtest.h>

#include "sluice/app/viewer_schedule.h"

namespace sluice::app {

inline constexpr core::ViewerId kAnn = 1;
inline constexpr core::ViewerId kBob = 2;

/// A schedule for viewers with a window of two frames, on a clock that the tests set.
class ViewerScheduleTest : public testing::Test {
 protected:
  static stream::View view(double maxRate = 1000) { return {.size = {640, 480}, .maxRate = maxRate, .stills = false}; }

  /// The next job, drawn and encoded in no time.
  std::optional<ViewerSchedule::Job> next(std::chrono::milliseconds at = {}) {
    std::optional<ViewerSchedule::Job> job = schedule_.next(start_ + at);
    if (job) {
      schedule_.drawn(*job, 0.001);
      schedule_.encoded(job->owner);
    }
    return job;
  }

  /// Its only viewer's share.
  static const core::Delivery& share(const std::optional<ViewerSchedule::Job>& job) {
    return job.value().encodings.at(0).deliveries.at(0);
  }

  /// All who were sent it have drawn it.
  void finish(const ViewerSchedule::Job& job, std::chrono::milliseconds at) {
    for (const ViewerSchedule::Encoding& encoding : job.encodings) {
      for (const core::Delivery& delivery : encoding.deliveries) {
        schedule_.acknowledge(delivery.viewer, delivery.frameId, start_ + at);
      }
    }
  }

  ViewerSchedule::Clock::time_point start_ = ViewerSchedule::Clock::now();
  ViewerSchedule schedule_{2};
};

}  // namespace sluice::app
