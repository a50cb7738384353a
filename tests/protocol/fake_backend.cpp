#include "fake_backend.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "sluice/core/input_error.h"
#include "viewer/test_viewer.h"

namespace sluice::stream::test {

FakeBackend::FakeBackend(std::size_t frameBytes, std::uint32_t window) : frameBytes_(frameBytes), window_(window) {}

FakeBackend::~FakeBackend() { finish(); }

void FakeBackend::start(Server& server) {
  server_ = &server;
  thread_ = std::thread([this] { makeFrames(); });
}

void FakeBackend::finish() {
  {
    const std::lock_guard lock(mutex_);
    finishing_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

std::string FakeBackend::payloadFor(float eyeX) { return "eye " + std::to_string(eyeX) + ";"; }

FakeBackend::Counts FakeBackend::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

bool FakeBackend::waitForLeft(int count) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, sluice::test::kPatience, [&] { return counts_.left >= count; });
}

std::uint32_t FakeBackend::mostUnderWay() const {
  const std::lock_guard lock(mutex_);
  return mostUnderWay_;
}

v1::Welcome FakeBackend::welcome() {
  v1::Welcome welcome;
  welcome.set_protocol_version(1);
  welcome.set_server_version("test");
  welcome.add_codecs(v1::JPEG);
  welcome.add_codecs(v1::PNG);
  return welcome;
}

void FakeBackend::join(core::ViewerId viewer, const Visitor&) {
  const std::lock_guard lock(mutex_);
  ++counts_.joined;
  viewers_[viewer];
}

void FakeBackend::leave(core::ViewerId viewer) {
  {
    const std::lock_guard lock(mutex_);
    ++counts_.left;
    viewers_.erase(viewer);
  }
  changed_.notify_all();
}

void FakeBackend::setView(core::ViewerId viewer, std::uint64_t sequence, const View& view) {
  {
    const std::lock_guard lock(mutex_);
    viewers_[viewer].view = view;
    viewers_[viewer].reflects = sequence;
  }
  changed_.notify_all();
}

void FakeBackend::setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera) {
  {
    const std::lock_guard lock(mutex_);
    viewers_[viewer].camera = camera;
    viewers_[viewer].reflects = sequence;
  }
  changed_.notify_all();
}

void FakeBackend::acknowledge(core::ViewerId viewer, std::uint64_t frameId) {
  {
    const std::lock_guard lock(mutex_);
    viewers_[viewer].lastAcknowledged = frameId;
  }
  changed_.notify_all();
}

void FakeBackend::updateScene(core::ViewerId viewer, std::uint64_t sequence, const v1::UpdateScene& update) {
  if (update.scene().look().smoothing().time() > 50) {
    throw core::InputError("", "look.smoothing.time", "is outside [0, 50] d²");
  }
  v1::ServerMessage changed;
  *changed.mutable_scene_changed()->mutable_scene() = update.scene();
  server_->broadcast(changed);
  v1::ServerMessage done;
  done.set_in_reply_to(sequence);
  done.mutable_done();
  server_->send(viewer, done);
}

void FakeBackend::control(core::ViewerId viewer, std::uint64_t sequence, const v1::Control&) {
  {
    const std::lock_guard lock(mutex_);
    ++counts_.controls;
  }
  answerDone(viewer, sequence);
}

void FakeBackend::interact(core::ViewerId viewer, std::uint64_t sequence, const v1::Interact&) {
  answerDone(viewer, sequence);
}

void FakeBackend::pick(core::ViewerId viewer, std::uint64_t sequence, const PickPoint& point) {
  v1::ServerMessage message;
  message.set_in_reply_to(sequence);
  message.mutable_picked()->set_hit(point.x < 0.5);
  server_->send(viewer, message);
}

void FakeBackend::metrics(MetricsText& text) const {
  text.counter("sluice_controls_total", "Controls taken.", counts().controls);
}

void FakeBackend::answerDone(core::ViewerId viewer, std::uint64_t sequence) {
  v1::ServerMessage done;
  done.set_in_reply_to(sequence);
  done.mutable_done();
  server_->send(viewer, done);
}

void FakeBackend::loadScene(core::ViewerId, std::uint64_t, const v1::LoadScene& scene) {
  throw core::InputError("", "name", scene.name() + " is no shipped scene");
}

void FakeBackend::snapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                           const std::optional<core::Camera>&) {
  core::EncodedFrame frame;
  frame.size = size;
  frame.bytes.assign(frameBytes_, std::uint8_t{7});
  server_->sendFrame(frame,
                     {.viewer = viewer, .frameId = 0, .reflectsSequence = 0, .inReplyTo = sequence, .askedAt = {}});
}

void FakeBackend::makeFrames() {
  std::unique_lock lock(mutex_);
  while (!finishing_) {
    std::vector<Outgoing> frames;
    for (auto& [id, viewer] : viewers_) {
      const auto underWay = static_cast<std::uint32_t>(viewer.lastFrame - viewer.lastAcknowledged);
      mostUnderWay_ = std::max(mostUnderWay_, underWay);
      if (!viewer.view || underWay >= window_) continue;
      ++viewer.lastFrame;
      frames.push_back(frameFor(id, viewer));
    }
    if (frames.empty()) {
      changed_.wait(lock);
      continue;
    }
    lock.unlock();
    for (const Outgoing& outgoing : frames) server_->sendFrame(outgoing.frame, outgoing.delivery);
    lock.lock();
  }
}

FakeBackend::Outgoing FakeBackend::frameFor(core::ViewerId id, const Viewer& viewer) const {
  core::EncodedFrame frame;
  frame.tag.stages = {{"splats", 1.0}, {"encode", 2.0}};
  frame.size = viewer.view->size;
  frame.codec = viewer.view->codecs.front();
  const std::string text = payloadFor(viewer.camera.eye.x());
  frame.bytes.assign(text.begin(), text.end());
  frame.bytes.resize(std::max(frameBytes_, text.size()));
  return {
      std::move(frame),
      {.viewer = id, .frameId = viewer.lastFrame, .reflectsSequence = viewer.reflects, .inReplyTo = 0, .askedAt = {}}};
}

}  // namespace sluice::stream::test
