#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sluice/stream/backend.h"

namespace sluice::stream::test {

/// Writes down each call as a line; `onCall`, if set, runs at each of them and may throw.
class RecordingBackend final : public Backend {
 public:
  std::vector<std::string> calls;
  std::function<void(const std::string& call)> onCall;
  std::optional<View> view;
  std::optional<core::Camera> camera;
  std::optional<Visitor> visitor;
  std::optional<PickPoint> point;
  std::vector<v1::Codec> codecs{v1::JPEG, v1::PNG};

  v1::Welcome welcome() override {
    record("welcome");
    v1::Welcome welcome;
    welcome.set_protocol_version(1);
    for (const v1::Codec codec : codecs) welcome.add_codecs(codec);
    return welcome;
  }
  void join(core::ViewerId viewer, const Visitor& who) override {
    visitor = who;
    record("join", viewer);
  }
  void leave(core::ViewerId viewer) override { record("leave", viewer); }
  void setView(core::ViewerId, std::uint64_t sequence, const View& asked) override {
    view = asked;
    record("setView", sequence);
  }
  void setCamera(core::ViewerId, std::uint64_t sequence, const core::Camera& asked) override {
    camera = asked;
    record("setCamera", sequence);
  }
  void acknowledge(core::ViewerId, std::uint64_t frameId) override { record("acknowledge", frameId); }
  void updateScene(core::ViewerId, std::uint64_t sequence, const v1::UpdateScene&) override {
    record("updateScene", sequence);
  }
  void requestKeyframe(core::ViewerId viewer) override { record("requestKeyframe", viewer); }
  void interact(core::ViewerId, std::uint64_t, const v1::Interact& interact) override {
    record(std::string("interact ").append(v1::Interact::Action_Name(interact.action())));
  }
  void pick(core::ViewerId, std::uint64_t sequence, const PickPoint& asked) override {
    point = asked;
    record("pick", sequence);
  }
  void metrics(MetricsText& text) const override { text.gauge("sluice_test", "Of the test.", 1.5); }
  void control(core::ViewerId, std::uint64_t, const v1::Control& control) override {
    record(std::string("control ").append(v1::Control::Action_Name(control.action())));
  }
  void loadScene(core::ViewerId, std::uint64_t, const v1::LoadScene& scene) override {
    record(std::string("loadScene ").append(scene.name()));
  }
  void snapshot(core::ViewerId, std::uint64_t, core::ImageSize size,
                const std::optional<core::Camera>& asked) override {
    camera = asked;
    std::string call = "snapshot ";
    call.append(std::to_string(size.width)).append("x").append(std::to_string(size.height));
    record(call);
  }

 private:
  void record(const std::string& verb, std::uint64_t number) { record(verb + " " + std::to_string(number)); }
  void record(const std::string& call) {
    calls.push_back(call);
    if (onCall) onCall(call);
  }
};

}  // namespace sluice::stream::test
