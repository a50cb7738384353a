#include "sluice/app/encode_loop.h"

#include <algorithm>
#include <utility>

namespace sluice::app {

EncodeLoop::EncodeLoop(Sink sink) : sink_(std::move(sink)), thread_([this] { loop(); }) {}

EncodeLoop::~EncodeLoop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void EncodeLoop::put(core::Frame frame, const encode::EncoderSettings& settings) {
  {
    const std::lock_guard lock(mutex_);
    const auto replaced = std::find_if(waiting_.begin(), waiting_.end(), [&](const Work& work) {
      return work.frame.tag.viewer == frame.tag.viewer && work.frame.tag.inReplyTo == 0 && frame.tag.inReplyTo == 0;
    });
    if (replaced != waiting_.end()) {
      *replaced = {std::move(frame), settings};  // keeps its turn
    } else {
      waiting_.push_back({std::move(frame), settings});
    }
  }
  wake_.notify_one();
}

void EncodeLoop::leave(core::ViewerId viewer) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(waiting_, [&](const Work& work) { return work.frame.tag.viewer == viewer; });
    left_.push_back(viewer);
  }
  wake_.notify_one();
}

EncodeLoop::Encoder& EncodeLoop::encoderFor(const Work& work) {
  Encoder& entry = encoders_[work.frame.tag.viewer];
  if (!entry.encoder || entry.settings != work.settings) {
    entry = {work.settings, encode::makeEncoder(work.settings)};
  }
  return entry;
}

void EncodeLoop::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return stopping_ || !waiting_.empty() || !left_.empty(); });
    if (stopping_) return;
    for (; !left_.empty(); left_.pop_front()) encoders_.erase(left_.front());
    if (waiting_.empty()) continue;

    const Work work = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    // A snapshot must not disturb the state of the viewer's stream.
    if (work.frame.tag.inReplyTo != 0) {
      sink_(encode::makeEncoder(work.settings)->encode(work.frame));
    } else {
      sink_(encoderFor(work).encoder->encode(work.frame));
    }
    lock.lock();
  }
}

}  // namespace sluice::app
