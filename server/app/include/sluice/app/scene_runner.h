#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "sluice/app/live_scene.h"
#include "sluice/app/pace.h"
#include "sluice/core/frame.h"
#include "sluice/core/input_error.h"
#include "sluice/core/mailbox.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/session.pb.h"

namespace sluice::app {

/// Owns the scene and its particle source, and runs them on a thread of its own. The source moves on only while the
/// scene plays and somebody watches; a snapshot is made only when the last one has been taken, and of every state in
/// which the source comes to rest.
class SceneRunner {
 public:
  /// Who asked; answered through Events::done or Events::failed.
  struct Request {
    core::ViewerId viewer = 0;
    std::uint64_t sequence = 0;
  };

  struct Control {
    v1::Control::Action action;
  };
  using Command = std::variant<Control, v1::UpdateScene, v1::LoadScene>;

  /// What happens, told on the runner's thread. Must return soon; thread-safe by its implementer.
  class Events {
   public:
    virtual ~Events() = default;
    /// A new snapshot lies in `snapshots()`.
    virtual void particlesChanged() = 0;
    /// A new scene lies in `scene()`; null request: the runner changed it by itself.
    virtual void sceneChanged(const Request& by, bool restarted) = 0;
    virtual void stats(const v1::Stats& stats) = 0;
    virtual void done(const Request& request) = 0;
    virtual void failed(const Request& request, const core::InputError& error) = 0;
  };

  /// Opens the source at once (throws core::InputError) and rests until `start`.
  SceneRunner(LiveScene scene, int threads);
  ~SceneRunner();

  /// `events` must outlive the runner.
  void start(Events& events);
  void stop();

  // Thread-safe:

  enum class Enqueued { Accepted, Full };
  Enqueued enqueue(const Request& request, Command command);

  /// The number of viewers; at 0 the source rests.
  void setAudience(std::size_t viewers);

  core::Mailbox<core::ParticleSnapshot>& snapshots() { return snapshots_; }
  std::shared_ptr<const LiveScene> scene() const;
  v1::Stats lastStats() const;

 private:
  using Clock = std::chrono::steady_clock;

  void loop();
  void execute(const Request& request, const Command& command);
  void apply(const Request& request, const Control& control);
  void apply(const Request& request, const v1::UpdateScene& update);
  void apply(const Request& request, const v1::LoadScene& load);
  void advance();
  void replaceScene(LiveScene scene);
  void publishSnapshot();
  void publishStats();
  bool canMove() const;

  const int threads_;
  Events* events_ = nullptr;

  // Owned by the runner's thread once it has started.
  std::unique_ptr<core::ParticleSource> source_;
  bool playing_ = true;
  bool atEnd_ = false;
  bool unpublished_ = false;
  std::uint64_t snapshotSequence_ = 0;
  Pace pace_;
  Clock::time_point nextStats_{};
  std::size_t particleCount_ = 0;

  core::Mailbox<core::ParticleSnapshot> snapshots_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::pair<Request, Command>> commands_;
  std::shared_ptr<const LiveScene> scene_;
  v1::Stats stats_;
  std::size_t audience_ = 0;
  bool stopping_ = false;

  std::thread thread_;
};

}  // namespace sluice::app
