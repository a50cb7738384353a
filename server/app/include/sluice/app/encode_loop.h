#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "sluice/core/frame.h"
#include "sluice/encode/frame_encoder.h"

namespace sluice::app {

/// Encodes frames on a thread of its own. Each viewer has room for one waiting frame, which a newer one replaces, and
/// one waiting snapshot, which nothing replaces; so at most two pictures wait for each viewer.
class EncodeLoop {
 public:
  /// Called on the encoding thread with every encoded frame.
  using Sink = std::function<void(core::EncodedFrame)>;

  explicit EncodeLoop(Sink sink);
  ~EncodeLoop();

  // Thread-safe:

  /// Takes a frame for the viewer in its tag.
  void put(core::Frame frame, const encode::EncoderSettings& settings);

  /// Forgets the viewer's waiting frames and its encoder.
  void leave(core::ViewerId viewer);

 private:
  struct Work {
    core::Frame frame;
    encode::EncoderSettings settings;
  };
  struct Encoder {
    encode::EncoderSettings settings;
    std::unique_ptr<encode::FrameEncoder> encoder;
  };

  void loop();
  Encoder& encoderFor(const Work& work);

  Sink sink_;
  std::map<core::ViewerId, Encoder> encoders_;  // the encoding thread's own

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Work> waiting_;  // at most one frame and one snapshot of each viewer
  std::deque<core::ViewerId> left_;
  bool stopping_ = false;

  std::thread thread_;
};

}  // namespace sluice::app
