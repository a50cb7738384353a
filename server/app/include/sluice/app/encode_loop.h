#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "sluice/app/viewer_schedule.h"
#include "sluice/core/frame.h"
#include "sluice/encode/frame_encoder.h"

namespace sluice::app {

/// Encodes pictures on a thread of its own, each once for every stream that shows it. What waits is bounded by whoever
/// draws: two pictures for each owner, as ViewerSchedule has it.
class EncodeLoop {
 public:
  /// Told on the encoding thread. Must return soon.
  class Events {
   public:
    virtual ~Events() = default;
    virtual void encoded(const core::EncodedFrame& frame, const std::vector<core::Delivery>& deliveries) = 0;
    virtual void encodingFailed(const std::vector<core::Delivery>& deliveries, const std::string& problem) = 0;
    /// All encodings of a picture of this owner are done.
    virtual void pictureDone(core::ViewerId owner) = 0;
  };

  /// `events` must outlive the loop.
  explicit EncodeLoop(Events& events);
  ~EncodeLoop();

  // Thread-safe:

  void put(core::Frame frame, ViewerSchedule::Job job);

  /// Forgets the encoders of all other streams.
  void keepOnly(std::set<StreamKey> streams);

 private:
  struct Work {
    core::Frame frame;
    ViewerSchedule::Job job;
  };
  struct Encoder {
    encode::EncoderSettings settings;
    std::unique_ptr<encode::FrameEncoder> encoder;
  };

  void loop();
  void encode(const core::Frame& frame, const ViewerSchedule::Encoding& encoding);
  encode::FrameEncoder& encoderFor(const StreamKey& stream, const encode::EncoderSettings& settings);

  Events& events_;
  std::map<StreamKey, Encoder> encoders_;  // the encoding thread's own

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Work> waiting_;
  std::optional<std::set<StreamKey>> kept_;
  bool stopping_ = false;

  std::thread thread_;
};

}  // namespace sluice::app
