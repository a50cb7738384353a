#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "sluice/app/command_log.h"
#include "sluice/app/live_scene.h"
#include "sluice/app/pace.h"
#include "sluice/app/scene_run.h"
#include "sluice/core/frame.h"
#include "sluice/core/input_error.h"
#include "sluice/core/mailbox.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/session.pb.h"

namespace sluice::app {

struct SceneRunnerOptions {
  int threads = 0;                                    ///< Of the simulation; 0: one for each core.
  std::uint64_t mostParticles = 0;                    ///< Of scenes that viewers ask for; 0: what memory allows.
  std::optional<std::filesystem::path> commandLog{};  ///< Where to write what viewers ask of the run.
};

/// Owns a run and moves it on, on a thread of its own. It moves only while the scene plays and somebody watches; a
/// snapshot is made only when the last one has been taken, and of every state in which the source comes to rest.
class SceneRunner {
 public:
  /// Who asked; answered through Events::done or Events::failed.
  struct Request {
    core::ViewerId viewer = 0;
    std::uint64_t sequence = 0;
  };

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
  SceneRunner(LiveScene scene, const SceneRunnerOptions& options);
  ~SceneRunner();

  /// `events` must outlive the runner.
  void start(Events& events);
  /// Ends the thread and the log of commands.
  void stop();

  // Thread-safe:

  enum class Enqueued { Accepted, Full };
  Enqueued enqueue(const Request& request, SceneCommand command);

  /// The number of viewers; at 0 the source rests.
  void setAudience(std::size_t viewers);

  core::Mailbox<core::ParticleSnapshot>& snapshots() { return snapshots_; }
  std::shared_ptr<const LiveScene> scene() const;
  v1::Stats lastStats() const;

 private:
  using Clock = std::chrono::steady_clock;

  void loop();
  void execute(const Request& request, const SceneCommand& command);
  void carryOut(const Request& request, const SceneCommand& command);
  void log(std::uint64_t afterSteps, const SceneCommand& command);
  void advance();
  void settleGoal();
  void showScene();
  void publishSnapshot();
  void publishStats();
  bool canMove() const;

  Events* events_ = nullptr;

  // Owned by the runner's thread once it has started.
  SceneRun run_;
  std::optional<CommandLog> log_;
  std::optional<Request> waitsForGoal_;
  bool unpublished_ = false;
  std::uint64_t snapshotSequence_ = 0;
  Pace pace_;
  Clock::time_point nextStats_{};
  std::size_t particleCount_ = 0;

  core::Mailbox<core::ParticleSnapshot> snapshots_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::pair<Request, SceneCommand>> commands_;
  std::shared_ptr<const LiveScene> scene_;
  v1::Stats stats_;
  std::size_t audience_ = 0;
  bool stopping_ = false;

  std::thread thread_;
};

}  // namespace sluice::app
