#include "sluice/app/encode_loop.h"

#include <exception>
#include <utility>

namespace sluice::app {

EncodeLoop::EncodeLoop(Events& events) : events_(events), thread_([this] { loop(); }) {}

EncodeLoop::~EncodeLoop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void EncodeLoop::put(core::Frame frame, ViewerSchedule::Job job) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(frame), std::move(job)});
  }
  wake_.notify_one();
}

void EncodeLoop::keepOnly(std::set<StreamKey> streams) {
  {
    const std::lock_guard lock(mutex_);
    kept_ = std::move(streams);
  }
  wake_.notify_one();
}

encode::FrameEncoder& EncodeLoop::encoderFor(const StreamKey& stream, const encode::EncoderSettings& settings) {
  Encoder& entry = encoders_[stream];
  if (!entry.encoder || (entry.settings != settings && !entry.encoder->retune(settings))) {
    entry.encoder = encode::makeEncoder(settings);
  }
  entry.settings = settings;
  return *entry.encoder;
}

void EncodeLoop::encode(const core::Frame& frame, const ViewerSchedule::Encoding& encoding) {
  try {
    if (!encoding.stream) {
      events_.encoded(encode::makeEncoder(encoding.settings)->encode(frame), encoding.deliveries);
      return;
    }
    encode::FrameEncoder& encoder = encoderFor(*encoding.stream, encoding.settings);
    if (encoding.keyframe) encoder.requestKeyframe();
    events_.encoded(encoder.encode(frame), encoding.deliveries);
  } catch (const std::exception& error) {
    // The next frame gets a new encoder, and so begins with a keyframe.
    if (encoding.stream) encoders_.erase(*encoding.stream);
    events_.encodingFailed(encoding.deliveries, error.what());
  }
}

void EncodeLoop::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return stopping_ || !waiting_.empty() || kept_; });
    if (stopping_) return;
    if (const auto kept = std::exchange(kept_, std::nullopt)) {
      std::erase_if(encoders_, [&](const auto& entry) { return !kept->contains(entry.first); });
    }
    if (waiting_.empty()) continue;

    const Work work = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    for (const ViewerSchedule::Encoding& encoding : work.job.encodings) encode(work.frame, encoding);
    events_.pictureDone(work.job.owner);
    lock.lock();
  }
}

}  // namespace sluice::app
