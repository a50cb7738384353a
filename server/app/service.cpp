#include "sluice/app/service.h"

#include <utility>

#include <spdlog/spdlog.h>

#include "sluice/app/encode_loop.h"
#include "sluice/app/render_loop.h"
#include "sluice/app/scene_runner.h"
#include "sluice/app/to_proto.h"
#include "sluice/app/version.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/scene.h"

namespace sluice::app {

namespace {

v1::ServerMessage errorMessage(std::uint64_t inReplyTo, v1::Error::Code code, const std::string& fieldPath,
                               const std::string& problem) {
  v1::ServerMessage message;
  message.set_in_reply_to(inReplyTo);
  v1::Error& error = *message.mutable_error();
  error.set_code(code);
  error.set_field_path(fieldPath);
  error.set_message(problem);
  return message;
}

}  // namespace

/// The joints between the stages: what one tells becomes what another does. Backend is called on the io thread, the
/// events on the threads of the runner and the renderer; all that this class itself holds is constant after its
/// constructor.
class Service::Impl final : stream::Backend, SceneRunner::Events, RenderLoop::Events {
 public:
  explicit Impl(ServiceOptions options)
      : runner_(std::move(options.scene), options.threads),
        server_(options.server, *this),
        encoder_([this](const core::EncodedFrame& frame) { server_.sendFrame(frame.tag.viewer, frame); }),
        renderer_(runner_.snapshots(), runner_.scene(), options.server.frameWindow, *this) {
    runner_.start(*this);
  }

  // The runner calls into the renderer and the server, so it stops first.
  ~Impl() override { runner_.stop(); }

  stream::Server& server() { return server_; }
  const std::string& rendererName() const { return renderer_.rendererName(); }

 private:
  // ---- stream::Backend: what viewers ask

  v1::Welcome welcome() override {
    v1::Welcome welcome;
    welcome.set_protocol_version(1);
    welcome.set_server_version(kVersion);
    welcome.set_renderer(renderer_.rendererName());
    for (const scene::ShippedScene& shipped : scene::shippedScenes()) {
      v1::SceneEntry& entry = *welcome.add_scenes();
      entry.set_name(shipped.name);
      entry.set_title(shipped.title);
    }
    welcome.add_codecs(v1::JPEG);
    welcome.add_codecs(v1::PNG);
    const std::shared_ptr<const LiveScene> live = runner_.scene();
    *welcome.mutable_scene() = live->scene;
    welcome.set_scene_name(live->name);
    welcome.set_paused(runner_.lastStats().paused());
    return welcome;
  }

  void join(core::ViewerId viewer) override {
    const core::Camera start = scene::toCamera(runner_.scene()->scene.camera());
    changeSchedule([&](ViewerSchedule& schedule) { schedule.join(viewer, start); });
    v1::ServerMessage message;
    *message.mutable_stats() = runner_.lastStats();
    server_.send(viewer, std::move(message));
  }

  void leave(core::ViewerId viewer) override {
    renderer_.leave(viewer);
    encoder_.leave(viewer);
    changeSchedule([](ViewerSchedule&) {});
  }

  void setView(core::ViewerId viewer, std::uint64_t sequence, const stream::View& view) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.setView(viewer, sequence, view); });
  }

  void setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.setCamera(viewer, sequence, camera); });
  }

  void acknowledge(core::ViewerId viewer, std::uint64_t frameId) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.acknowledge(viewer, frameId); });
  }

  void updateScene(core::ViewerId viewer, std::uint64_t sequence, const v1::UpdateScene& update) override {
    enqueue({viewer, sequence}, update);
  }

  void control(core::ViewerId viewer, std::uint64_t sequence, v1::Control::Action action) override {
    enqueue({viewer, sequence}, SceneRunner::Control{action});
  }

  void loadScene(core::ViewerId viewer, std::uint64_t sequence, const v1::LoadScene& scene) override {
    enqueue({viewer, sequence}, scene);
  }

  void snapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                const std::optional<core::Camera>& camera) override {
    bool accepted = false;
    renderer_.schedule(
        [&](ViewerSchedule& schedule) { accepted = schedule.requestSnapshot(viewer, sequence, size, camera); });
    if (!accepted) {
      server_.send(viewer, errorMessage(sequence, v1::Error::REFUSED, "", "a snapshot is under way already"));
    }
  }

  // ---- SceneRunner::Events

  void particlesChanged() override { renderer_.particlesChanged(); }

  void sceneChanged(const SceneRunner::Request& by, bool restarted) override {
    const std::shared_ptr<const LiveScene> live = runner_.scene();
    renderer_.sceneChanged(live, by.viewer, by.sequence);
    v1::ServerMessage message;
    v1::SceneChanged& changed = *message.mutable_scene_changed();
    *changed.mutable_scene() = live->scene;
    changed.set_restarted(restarted);
    changed.set_scene_name(live->name);
    server_.broadcast(std::move(message));
  }

  void stats(const v1::Stats& stats) override {
    v1::ServerMessage message;
    *message.mutable_stats() = stats;
    server_.broadcast(std::move(message));
  }

  void done(const SceneRunner::Request& request) override {
    v1::ServerMessage message;
    message.set_in_reply_to(request.sequence);
    message.mutable_done();
    server_.send(request.viewer, std::move(message));
  }

  void failed(const SceneRunner::Request& request, const core::InputError& error) override {
    const std::string problem = error.where().empty() ? error.problem() : error.where() + ": " + error.problem();
    server_.send(request.viewer, errorMessage(request.sequence, v1::Error::INVALID, error.fieldPath(), problem));
  }

  // ---- RenderLoop::Events

  void frame(core::Frame frame, const stream::View& view) override {
    encoder_.put(std::move(frame), {.codec = view.codec, .quality = view.quality});
  }

  void framePlan(core::ViewerId viewer, const core::Plan& plan) override {
    v1::ServerMessage message;
    *message.mutable_plan_changed()->mutable_frame() = toProto(plan);
    *message.mutable_plan_changed()->mutable_steps() = toProto(runner_.scene()->steps);
    server_.send(viewer, std::move(message));
  }

  void frameFailed(core::ViewerId viewer, std::uint64_t inReplyTo, const std::string& problem) override {
    spdlog::error("viewer {}: frame failed: {}", viewer, problem);
    server_.send(viewer, errorMessage(inReplyTo, v1::Error::FAILED, "", problem));
  }

  // ----

  void enqueue(const SceneRunner::Request& request, SceneRunner::Command command) {
    if (runner_.enqueue(request, std::move(command)) == SceneRunner::Enqueued::Full) {
      server_.send(request.viewer,
                   errorMessage(request.sequence, v1::Error::REFUSED, "", "too many requests are waiting"));
    }
  }

  /// The scene moves on only while somebody watches.
  void changeSchedule(const std::function<void(ViewerSchedule&)>& change) {
    std::size_t viewers = 0;
    renderer_.schedule([&](ViewerSchedule& schedule) {
      change(schedule);
      viewers = schedule.size();
    });
    runner_.setAudience(viewers);
  }

  SceneRunner runner_;
  stream::Server server_;
  EncodeLoop encoder_;
  RenderLoop renderer_;
};

Service::Service(ServiceOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Service::~Service() = default;

std::uint16_t Service::port() const { return impl_->server().port(); }
const std::string& Service::rendererName() const { return impl_->rendererName(); }
void Service::run() { impl_->server().run(); }
void Service::stop(const std::string& reason) { impl_->server().stop(reason); }

}  // namespace sluice::app
