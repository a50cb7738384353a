#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "sluice/app/live_scene.h"
#include "sluice/app/viewer_schedule.h"
#include "sluice/core/frame.h"
#include "sluice/core/mailbox.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/core/plan.h"
#include "sluice/render/fluid_renderer.h"
#include "sluice/v1/session.pb.h"

namespace sluice::app {

/// Owns the GL context and draws, on a thread of its own, the pictures that the viewers' schedule asks for.
class RenderLoop {
 public:
  class Events {
   public:
    virtual ~Events() = default;
    /// A picture, its tag complete; on the render thread.
    virtual void frame(core::Frame frame, ViewerSchedule::Job job) = 0;
    /// The picture of a viewer is made differently from its last one; on the render thread.
    virtual void framePlan(core::ViewerId viewer, const core::Plan& plan) = 0;
    /// A picture could not be made; on the render thread.
    virtual void frameFailed(const ViewerSchedule::Job& job, const std::string& problem) = 0;
    /// The answer to a Pick; on the render thread.
    virtual void picked(core::ViewerId viewer, std::uint64_t sequence, const v1::Picked& picked) = 0;
  };

  /// Makes the GL context; throws core::EnvironmentError. `events` and `snapshots` must outlive the loop.
  RenderLoop(core::Mailbox<core::ParticleSnapshot>& snapshots, std::shared_ptr<const LiveScene> scene,
             std::uint32_t maxWindow, Events& events);
  ~RenderLoop();

  /// GL_RENDERER.
  const std::string& rendererName() const { return rendererName_; }

  // Thread-safe:

  /// Changes the viewers' schedule and draws what that makes due.
  void schedule(const std::function<void(ViewerSchedule&)>& change);

  void leave(core::ViewerId viewer);

  /// False where too many are waiting already.
  bool pick(core::ViewerId viewer, std::uint64_t sequence, const stream::PickPoint& point);

  /// A new snapshot lies in the mailbox.
  void particlesChanged();

  void sceneChanged(std::shared_ptr<const LiveScene> scene, core::ViewerId by, std::uint64_t sequence);

 private:
  void loop(std::promise<std::string> ready);
  void draw(render::FluidRenderer& renderer, const ViewerSchedule::Job& job, const LiveScene& scene);
  void tellPlan(const ViewerSchedule::Job& job, const core::Plan& plan);
  void answerPicks(std::unique_lock<std::mutex>& lock);

  struct PickRequest {
    core::ViewerId viewer = 0;
    std::uint64_t sequence = 0;
    stream::PickPoint point;
  };

  core::Mailbox<core::ParticleSnapshot>& snapshots_;
  Events& events_;
  std::string rendererName_;

  std::shared_ptr<const core::ParticleSnapshot> particles_;  // the render thread's own

  std::mutex mutex_;
  std::condition_variable wake_;
  ViewerSchedule schedule_;
  std::map<core::ViewerId, core::Plan> plans_;  // last told to each viewer
  std::shared_ptr<const LiveScene> scene_;
  std::deque<PickRequest> picks_;
  bool stopping_ = false;

  std::thread thread_;
};

}  // namespace sluice::app
