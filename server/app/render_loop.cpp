#include "sluice/app/render_loop.h"

#include <exception>
#include <utility>

#include "sluice/app/to_proto.h"
#include "sluice/core/ray.h"
#include "sluice/gl/context.h"
#include "sluice/render/pick_fluid.h"
#include "sluice/scene/convert.h"

namespace sluice::app {

namespace {

/// Picks that may wait, of all viewers together.
constexpr std::size_t kMaxPicks = 64;

}  // namespace

RenderLoop::RenderLoop(core::Mailbox<core::ParticleSnapshot>& snapshots, std::shared_ptr<const LiveScene> scene,
                       std::uint32_t maxWindow, Events& events)
    : snapshots_(snapshots), events_(events), schedule_(maxWindow), scene_(std::move(scene)) {
  std::promise<std::string> ready;
  std::future<std::string> name = ready.get_future();
  thread_ = std::thread([this, promise = std::move(ready)]() mutable { loop(std::move(promise)); });
  try {
    rendererName_ = name.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

RenderLoop::~RenderLoop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void RenderLoop::schedule(const std::function<void(ViewerSchedule&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(schedule_);
  }
  wake_.notify_one();
}

void RenderLoop::leave(core::ViewerId viewer) {
  const std::lock_guard lock(mutex_);
  schedule_.leave(viewer);
  plans_.erase(viewer);
}

void RenderLoop::particlesChanged() {
  schedule([](ViewerSchedule& schedule) { schedule.contentChanged(); });
}

void RenderLoop::sceneChanged(std::shared_ptr<const LiveScene> scene, core::ViewerId by, std::uint64_t sequence) {
  const core::Camera start = scene::toCamera(scene->scene.camera());
  {
    const std::lock_guard lock(mutex_);
    scene_ = std::move(scene);
    plans_.clear();  // the plan of the steps travels with that of the frame
    schedule_.setStartCamera(start);
    schedule_.contentChangedBy(by, sequence, ViewerSchedule::Clock::now());
  }
  wake_.notify_one();
}

void RenderLoop::loop(std::promise<std::string> ready) {
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<render::FluidRenderer> renderer;
  try {
    context = gl::Context::create();
    renderer = std::make_unique<render::FluidRenderer>(*context);
    if (context->isSoftware()) schedule_.setPipelineDepth(1);
    ready.set_value(context->rendererName());
  } catch (...) {
    ready.set_exception(std::current_exception());
    return;
  }

  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const ViewerSchedule::Clock::time_point now = ViewerSchedule::Clock::now();
    if (!picks_.empty()) {
      answerPicks(lock);
    } else if (const auto job = schedule_.next(now)) {
      const std::shared_ptr<const LiveScene> scene = scene_;
      lock.unlock();
      draw(*renderer, *job, *scene);
      lock.lock();
    } else if (const auto due = schedule_.nextDue(now)) {
      wake_.wait_until(lock, *due);
    } else {
      wake_.wait(lock);
    }
  }
}

void RenderLoop::draw(render::FluidRenderer& renderer, const ViewerSchedule::Job& job, const LiveScene& scene) {
  if (auto newest = snapshots_.take()) particles_ = std::move(newest);

  const ViewerSchedule::Clock::time_point begun = ViewerSchedule::Clock::now();
  core::Frame frame;
  try {
    frame = renderer.render(*particles_, scene.scene, job.camera, job.size);
  } catch (const std::exception& error) {
    schedule([&](ViewerSchedule& schedule) { schedule.failed(job); });
    events_.frameFailed(job, error.what());
    return;
  }
  const double seconds = std::chrono::duration<double>(ViewerSchedule::Clock::now() - begun).count();
  schedule([&](ViewerSchedule& schedule) { schedule.drawn(job, seconds); });
  frame.tag.snapshotSequence = particles_->sequence;
  frame.tag.simulationTime = particles_->time;
  frame.tag.still = job.still;
  events_.frame(std::move(frame), job);
  tellPlan(job, renderer.plan());
}

void RenderLoop::tellPlan(const ViewerSchedule::Job& job, const core::Plan& plan) {
  std::vector<core::ViewerId> news;
  {
    const std::lock_guard lock(mutex_);
    for (const ViewerSchedule::Encoding& encoding : job.encodings) {
      // The plan of a snapshot or a still is not what the viewer's stream costs.
      if (!encoding.stream) continue;
      for (const core::Delivery& delivery : encoding.deliveries) {
        if (!schedule_.contains(delivery.viewer) || plans_[delivery.viewer] == plan) continue;
        plans_[delivery.viewer] = plan;
        news.push_back(delivery.viewer);
      }
    }
  }
  for (const core::ViewerId viewer : news) events_.framePlan(viewer, plan);
}

bool RenderLoop::pick(core::ViewerId viewer, std::uint64_t sequence, const stream::PickPoint& point) {
  {
    const std::lock_guard lock(mutex_);
    if (picks_.size() >= kMaxPicks) return false;
    picks_.push_back({viewer, sequence, point});
  }
  wake_.notify_one();
  return true;
}

void RenderLoop::answerPicks(std::unique_lock<std::mutex>& lock) {
  for (std::deque<PickRequest> picks = std::exchange(picks_, {}); !picks.empty(); picks.pop_front()) {
    const PickRequest& request = picks.front();
    const auto seen = schedule_.seenBy(request.viewer);
    if (!seen) continue;
    lock.unlock();
    if (auto newest = snapshots_.peek()) particles_ = std::move(newest);
    const core::Ray ray =
        core::rayThrough(request.point.camera.value_or(seen->camera), seen->size, request.point.x, request.point.y);
    events_.picked(request.viewer, request.sequence, toProto(render::pickFluid(*particles_, ray), *particles_));
    lock.lock();
  }
}

}  // namespace sluice::app
