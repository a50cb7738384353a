#pragma once

#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "sluice/stream/server.h"

namespace sluice::stream::test {

/// Stands for the application: a thread that gives every viewer with a view a frame as soon as its window has room,
/// made by hand so that its bytes tell what it shows. Keeps a record of what happened.
class FakeBackend final : public Backend {
 public:
  /// `frameBytes` is the size of a frame's payload, at least; `window` is the number of frames it keeps under way.
  explicit FakeBackend(std::size_t frameBytes = 1000, std::uint32_t window = 2);
  ~FakeBackend() override;

  /// Starts the frames. The server must outlive them: call `finish` before it goes.
  void start(Server& server);
  void finish();

  /// What the payload of a frame starts with, for a camera whose eye has this x.
  static std::string payloadFor(float eyeX);

  struct Counts {
    int joined = 0;
    int left = 0;
    int controls = 0;
  };
  Counts counts() const;

  /// Waits until as many viewers have left; false where that takes too long.
  bool waitForLeft(int count);

  /// The most frames that were ever sent and not acknowledged to one viewer.
  std::uint32_t mostUnderWay() const;

  v1::Welcome welcome() override;
  void join(core::ViewerId viewer, const Visitor& visitor) override;
  void leave(core::ViewerId viewer) override;
  void setView(core::ViewerId viewer, std::uint64_t sequence, const View& view) override;
  void setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera) override;
  void acknowledge(core::ViewerId viewer, std::uint64_t frameId) override;
  void updateScene(core::ViewerId viewer, std::uint64_t sequence, const v1::UpdateScene& update) override;
  void control(core::ViewerId viewer, std::uint64_t sequence, const v1::Control& control) override;
  void loadScene(core::ViewerId viewer, std::uint64_t sequence, const v1::LoadScene& scene) override;
  void snapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                const std::optional<core::Camera>& camera) override;
  void requestKeyframe(core::ViewerId) override {}
  void interact(core::ViewerId viewer, std::uint64_t sequence, const v1::Interact& interact) override;
  void pick(core::ViewerId viewer, std::uint64_t sequence, const PickPoint& point) override;
  void metrics(MetricsText& text) const override;

 private:
  struct Viewer {
    std::optional<View> view;
    core::Camera camera;
    std::uint64_t reflects = 0;
    std::uint64_t lastFrame = 0;
    std::uint64_t lastAcknowledged = 0;
  };

  void makeFrames();
  struct Outgoing {
    core::EncodedFrame frame;
    core::Delivery delivery;
  };
  Outgoing frameFor(core::ViewerId id, const Viewer& viewer) const;
  void answerDone(core::ViewerId viewer, std::uint64_t sequence);

  const std::size_t frameBytes_;
  const std::uint32_t window_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<core::ViewerId, Viewer> viewers_;
  Counts counts_;
  std::uint32_t mostUnderWay_ = 0;
  bool finishing_ = false;
  Server* server_ = nullptr;
  std::thread thread_;
};

}  // namespace sluice::stream::test
