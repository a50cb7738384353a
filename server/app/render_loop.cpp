#include "sluice/app/render_loop.h"

#include <exception>
#include <utility>

#include "sluice/gl/context.h"
#include "sluice/scene/convert.h"

namespace sluice::app {

RenderLoop::RenderLoop(core::Mailbox<core::ParticleSnapshot>& snapshots, std::shared_ptr<const LiveScene> scene,
                       std::uint32_t frameWindow, Events& events)
    : snapshots_(snapshots), events_(events), schedule_(frameWindow), scene_(std::move(scene)) {
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
    schedule_.contentChangedBy(by, sequence);
  }
  wake_.notify_one();
}

void RenderLoop::loop(std::promise<std::string> ready) {
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<render::FluidRenderer> renderer;
  try {
    context = gl::Context::create();
    renderer = std::make_unique<render::FluidRenderer>(*context);
    ready.set_value(context->rendererName());
  } catch (...) {
    ready.set_exception(std::current_exception());
    return;
  }

  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const auto job = schedule_.next(ViewerSchedule::Clock::now());
    if (job) {
      const std::shared_ptr<const LiveScene> scene = scene_;
      lock.unlock();
      draw(*renderer, *job, *scene);
      lock.lock();
    } else if (const auto due = schedule_.nextDue()) {
      wake_.wait_until(lock, *due);
    } else {
      wake_.wait(lock);
    }
  }
}

void RenderLoop::draw(render::FluidRenderer& renderer, const ViewerSchedule::Job& job, const LiveScene& scene) {
  if (auto newest = snapshots_.take()) particles_ = std::move(newest);

  core::Frame frame;
  try {
    frame = renderer.render(*particles_, scene.scene, job.camera, job.view.size);
  } catch (const std::exception& error) {
    // The viewer will never acknowledge what it is never sent.
    schedule([&](ViewerSchedule& schedule) { schedule.acknowledge(job.viewer, job.frameId); });
    events_.frameFailed(job.viewer, job.inReplyTo, error.what());
    return;
  }
  frame.tag.viewer = job.viewer;
  frame.tag.frameId = job.frameId;
  frame.tag.reflectsSequence = job.reflectsSequence;
  frame.tag.inReplyTo = job.inReplyTo;
  frame.tag.snapshotSequence = particles_->sequence;
  frame.tag.simulationTime = particles_->time;
  events_.frame(std::move(frame), job.view);
  if (job.inReplyTo == 0) tellPlan(job.viewer, renderer.plan());
}

void RenderLoop::tellPlan(core::ViewerId viewer, const core::Plan& plan) {
  {
    const std::lock_guard lock(mutex_);
    if (!schedule_.contains(viewer) || plans_[viewer] == plan) return;
    plans_[viewer] = plan;
  }
  events_.framePlan(viewer, plan);
}

}  // namespace sluice::app
