#include "sluice/app/service.h"

#include <atomic>
#include <map>
#include <set>
#include <utility>

#include <spdlog/spdlog.h>

#include "sluice/app/encode_loop.h"
#include "sluice/app/render_loop.h"
#include "sluice/app/scene_runner.h"
#include "sluice/app/to_proto.h"
#include "sluice/app/version.h"
#include "sluice/scene/convert.h"
#include "sluice/scene/scene.h"
#include "sluice/stream/codec.h"

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

/// What has happened since the service started; counted on several threads.
struct ServiceCounters {
  std::atomic<std::uint64_t> picturesDrawn = 0;
  std::atomic<std::uint64_t> framesEncoded = 0;
  std::atomic<std::uint64_t> framesSent = 0;
  std::atomic<std::uint64_t> framesNotTaken = 0;
  std::atomic<std::uint64_t> failures = 0;
};

/// The joints between the stages: what one tells becomes what another does. Backend is called on the io thread, the
/// events on the threads of the runner, the renderer and the encoder.
class Service::Impl final : stream::Backend, SceneRunner::Events, RenderLoop::Events, EncodeLoop::Events {
 public:
  explicit Impl(ServiceOptions options)
      : codecs_(encode::availableCodecs()),
        runner_(std::move(options.scene), options.runner),
        server_(options.server, *this),
        encoder_(*this),
        renderer_(runner_.snapshots(), runner_.scene(), options.server.frameWindow, *this) {
    runner_.start(*this);
  }

  // The runner calls into the renderer and the server, so it stops first.
  ~Impl() override { runner_.stop(); }

  stream::Server& server() { return server_; }
  const std::string& rendererName() const { return renderer_.rendererName(); }

 private:
  using Clock = ViewerSchedule::Clock;

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
    for (const core::Codec codec : codecs_) welcome.add_codecs(stream::toProto(codec));
    const std::shared_ptr<const LiveScene> live = runner_.scene();
    *welcome.mutable_scene() = live->scene;
    welcome.set_scene_name(live->name);
    welcome.set_paused(runner_.lastStats().paused());
    return welcome;
  }

  void join(core::ViewerId viewer, const stream::Visitor& visitor) override {
    const core::Camera start = scene::toCamera(runner_.scene()->scene.camera());
    changeSchedule([&](ViewerSchedule& schedule) { schedule.join(viewer, start); });
    v1::ServerMessage message;
    *message.mutable_stats() = runner_.lastStats();
    server_.send(viewer, std::move(message));
    v1::ViewersChanged::Viewer& entry = visitors_[viewer];
    entry.set_viewer_id(viewer);
    entry.set_client(visitor.client);
    entry.set_role(visitor.role);
    tellVisitors();
  }

  void leave(core::ViewerId viewer) override {
    renderer_.leave(viewer);
    changeSchedule([](ViewerSchedule&) {});
    keepStreams();
    visitors_.erase(viewer);
    for (auto& [id, entry] : visitors_) {
      if (entry.follows() == viewer) entry.set_follows(0);
    }
    tellVisitors();
  }

  void setView(core::ViewerId viewer, std::uint64_t sequence, const stream::View& view) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.setView(viewer, sequence, view, Clock::now()); });
    keepStreams();
    const auto entry = visitors_.find(viewer);
    if (entry == visitors_.end()) return;
    entry->second.set_width(static_cast<std::uint32_t>(view.size.width));
    entry->second.set_height(static_cast<std::uint32_t>(view.size.height));
    entry->second.set_follows(view.follow);
    tellVisitors();
  }

  void setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.setCamera(viewer, sequence, camera, Clock::now()); });
  }

  void acknowledge(core::ViewerId viewer, std::uint64_t frameId) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.acknowledge(viewer, frameId, Clock::now()); });
  }

  void requestKeyframe(core::ViewerId viewer) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.requestKeyframe(viewer); });
  }

  void updateScene(core::ViewerId viewer, std::uint64_t sequence, const v1::UpdateScene& update) override {
    enqueue({viewer, sequence}, update);
  }

  void control(core::ViewerId viewer, std::uint64_t sequence, const v1::Control& control) override {
    enqueue({viewer, sequence}, control);
  }

  void loadScene(core::ViewerId viewer, std::uint64_t sequence, const v1::LoadScene& scene) override {
    enqueue({viewer, sequence}, scene);
  }

  void interact(core::ViewerId viewer, std::uint64_t sequence, const v1::Interact& interact) override {
    enqueue({viewer, sequence}, interact);
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

  void pick(core::ViewerId viewer, std::uint64_t sequence, const stream::PickPoint& point) override {
    if (!renderer_.pick(viewer, sequence, point)) {
      server_.send(viewer, errorMessage(sequence, v1::Error::REFUSED, "", "too many picks are waiting"));
    }
  }

  void metrics(stream::MetricsText& text) const override {
    const v1::Stats stats = runner_.lastStats();
    const auto count = [](const std::atomic<std::uint64_t>& counter) {
      return static_cast<double>(counter.load(std::memory_order_relaxed));
    };
    text.counter("sluice_pictures_drawn_total", "Pictures drawn.", count(counters_.picturesDrawn));
    text.counter("sluice_frames_encoded_total", "Encodings of pictures.", count(counters_.framesEncoded));
    text.counter("sluice_frames_sent_total", "Frames handed to viewers.", count(counters_.framesSent));
    text.counter("sluice_frames_not_taken_total", "Frames that their viewers had no room for.",
                 count(counters_.framesNotTaken));
    text.counter("sluice_failures_total", "Pictures that could not be drawn or encoded.", count(counters_.failures));
    text.gauge("sluice_simulation_seconds", "Simulated time.", stats.simulation_time());
    text.gauge("sluice_simulation_paused", "1 while the scene rests.", stats.paused() ? 1 : 0);
    text.gauge("sluice_simulation_particles", "Particles.", static_cast<double>(stats.particles()));
    text.gauge("sluice_simulation_steps", "Steps since the scene began.", static_cast<double>(stats.steps()));
    text.gauge("sluice_simulation_real_time_ratio", "Simulated seconds per second.", stats.real_time_factor());
    text.gauge("sluice_simulation_density_error_ratio", "Mean compression over the rest density.",
               stats.mean_density_error());
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

  void frame(core::Frame frame, ViewerSchedule::Job job) override {
    counters_.picturesDrawn.fetch_add(1, std::memory_order_relaxed);
    encoder_.put(std::move(frame), std::move(job));
  }

  void framePlan(core::ViewerId viewer, const core::Plan& plan) override {
    v1::ServerMessage message;
    *message.mutable_plan_changed()->mutable_frame() = toProto(plan);
    *message.mutable_plan_changed()->mutable_steps() = toProto(runner_.scene()->steps);
    server_.send(viewer, std::move(message));
  }

  void frameFailed(const ViewerSchedule::Job& job, const std::string& problem) override {
    for (const ViewerSchedule::Encoding& encoding : job.encodings) tellFailure(encoding.deliveries, problem);
  }

  void picked(core::ViewerId viewer, std::uint64_t sequence, const v1::Picked& picked) override {
    v1::ServerMessage message;
    message.set_in_reply_to(sequence);
    *message.mutable_picked() = picked;
    server_.send(viewer, std::move(message));
  }

  // ---- EncodeLoop::Events

  void encoded(const core::EncodedFrame& frame, const std::vector<core::Delivery>& deliveries) override {
    counters_.framesEncoded.fetch_add(1, std::memory_order_relaxed);
    // Said before they go out, so that no acknowledgement comes before it is known what it is for.
    renderer_.schedule([&](ViewerSchedule& schedule) {
      for (const core::Delivery& delivery : deliveries) schedule.sent(delivery, frame, true, Clock::now());
    });
    for (const core::Delivery& delivery : deliveries) {
      const stream::SendResult result = server_.sendFrame(frame, delivery);
      const bool taken = result == stream::SendResult::Sent || result == stream::SendResult::Queued;
      (taken ? counters_.framesSent : counters_.framesNotTaken).fetch_add(1, std::memory_order_relaxed);
      if (taken) continue;
      renderer_.schedule([&](ViewerSchedule& schedule) { schedule.sent(delivery, frame, false, Clock::now()); });
    }
  }

  void encodingFailed(const std::vector<core::Delivery>& deliveries, const std::string& problem) override {
    renderer_.schedule([&](ViewerSchedule& schedule) {
      for (const core::Delivery& delivery : deliveries) schedule.unsent(delivery);
    });
    tellFailure(deliveries, problem);
  }

  void pictureDone(core::ViewerId owner) override {
    renderer_.schedule([&](ViewerSchedule& schedule) { schedule.encoded(owner); });
  }

  // ----

  void enqueue(const SceneRunner::Request& request, SceneCommand command) {
    if (runner_.enqueue(request, std::move(command)) == SceneRunner::Enqueued::Full) {
      server_.send(request.viewer,
                   errorMessage(request.sequence, v1::Error::REFUSED, "", "too many requests are waiting"));
    }
  }

  void tellFailure(const std::vector<core::Delivery>& deliveries, const std::string& problem) {
    counters_.failures.fetch_add(1, std::memory_order_relaxed);
    for (const core::Delivery& delivery : deliveries) {
      spdlog::error("viewer {}: frame failed: {}", delivery.viewer, problem);
      server_.send(delivery.viewer, errorMessage(delivery.inReplyTo, v1::Error::FAILED, "", problem));
    }
  }

  void tellVisitors() {
    v1::ServerMessage message;
    for (const auto& [id, entry] : visitors_) *message.mutable_viewers_changed()->add_viewers() = entry;
    message.mutable_viewers_changed();
    server_.broadcast(std::move(message));
  }

  /// Encoders of streams that nobody is sent any more are let go.
  void keepStreams() {
    std::set<StreamKey> streams;
    renderer_.schedule([&](ViewerSchedule& schedule) { streams = schedule.streams(); });
    encoder_.keepOnly(std::move(streams));
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

  const std::vector<core::Codec> codecs_;
  ServiceCounters counters_;
  std::map<core::ViewerId, v1::ViewersChanged::Viewer> visitors_;  // The io thread's own.
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
