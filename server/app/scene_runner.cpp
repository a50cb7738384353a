#include "sluice/app/scene_runner.h"

#include <exception>
#include <new>
#include <set>
#include <string>
#include <utility>

#include "sluice/app/to_proto.h"
#include "sluice/scene/scene.h"

namespace sluice::app {

namespace {

/// Requests that may wait for the runner's attention; a step seldom takes longer than a slider's burst.
constexpr std::size_t kMaxWaiting = 256;

constexpr std::chrono::milliseconds kStatsInterval{250};

/// Viewers name shipped scenes and send scene texts; which files the server reads is its operator's choice. Files that
/// the present scene reads may be named again, wherever they stand in the wanted one.
void refuseForeignFiles(v1::Scene present, v1::Scene wanted) {
  std::set<std::string> known;
  for (const scene::FileReference& file : scene::filesOf(present)) known.insert(*file.path);
  for (const scene::FileReference& file : scene::filesOf(wanted)) {
    if (!known.contains(*file.path)) {
      throw core::InputError("", file.fieldPath, "viewers cannot name files of the server");
    }
  }
}

}  // namespace

SceneRunner::SceneRunner(LiveScene scene, int threads) : threads_(threads) {
  source_ = openSource(scene.scene, threads_);
  replaceScene(std::move(scene));
  playing_ = !this->scene()->scene.playback().paused();
  publishSnapshot();
  publishStats();
}

SceneRunner::~SceneRunner() { stop(); }

void SceneRunner::start(Events& events) {
  events_ = &events;
  thread_ = std::thread([this] { loop(); });
}

void SceneRunner::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

SceneRunner::Enqueued SceneRunner::enqueue(const Request& request, Command command) {
  {
    const std::lock_guard lock(mutex_);
    if (commands_.size() >= kMaxWaiting) return Enqueued::Full;
    commands_.emplace_back(request, std::move(command));
  }
  wake_.notify_one();
  return Enqueued::Accepted;
}

void SceneRunner::setAudience(std::size_t viewers) {
  {
    const std::lock_guard lock(mutex_);
    audience_ = viewers;
  }
  wake_.notify_one();
}

std::shared_ptr<const LiveScene> SceneRunner::scene() const {
  const std::lock_guard lock(mutex_);
  return scene_;
}

v1::Stats SceneRunner::lastStats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

bool SceneRunner::canMove() const { return playing_ && !atEnd_ && audience_ > 0; }

void SceneRunner::loop() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (!commands_.empty()) {
      const auto [request, command] = std::move(commands_.front());
      commands_.pop_front();
      lock.unlock();
      execute(request, command);
      lock.lock();
      continue;
    }
    const Clock::time_point now = Clock::now();
    const bool moving = canMove();
    const Clock::time_point due = moving ? pace_.due(now, source_->time()) : Clock::time_point::max();
    if (due <= now) {
      lock.unlock();
      advance();
      lock.lock();
    } else if (unpublished_) {
      // About to rest: what was skipped for speed is shown now.
      lock.unlock();
      publishSnapshot();
      publishStats();
      lock.lock();
    } else if (moving) {
      wake_.wait_until(lock, due);
    } else {
      wake_.wait(lock);
    }
  }
}

void SceneRunner::execute(const Request& request, const Command& command) {
  try {
    std::visit([&](const auto& c) { apply(request, c); }, command);
    events_->done(request);
  } catch (const core::InputError& error) {
    events_->failed(request, error);
  } catch (const std::bad_alloc&) {
    events_->failed(request, core::InputError("", "", "the server has not enough memory for this"));
  }
}

void SceneRunner::apply(const Request&, const Control& control) {
  switch (control.action) {
    case v1::Control::PLAY:
      if (std::exchange(atEnd_, false) && source_->halted().empty()) source_->reset();
      playing_ = true;
      break;
    case v1::Control::PAUSE:
      playing_ = false;
      break;
    case v1::Control::STEP:
      playing_ = false;
      advance();
      break;
    case v1::Control::RESET:
      source_->reset();
      atEnd_ = false;
      unpublished_ = true;
      break;
    default:
      throw core::InputError("", "control.action", "is none of PLAY, PAUSE, STEP, RESET");
  }
  pace_.restart(Clock::now(), source_->time());
  if (unpublished_) publishSnapshot();
  publishStats();
}

void SceneRunner::apply(const Request& request, const v1::UpdateScene& update) {
  const std::shared_ptr<const LiveScene> present = scene();
  scene::Update updated = scene::applyUpdate(present->scene, update.scene(), update.mask());
  refuseForeignFiles(present->scene, updated.scene);
  if (updated.restart) {
    source_ = openSource(updated.scene, threads_);
    atEnd_ = false;
  } else {
    source_->update(updated.scene);
  }
  replaceScene({std::move(updated.scene), present->name, {}});
  if (updated.restart) publishSnapshot();
  events_->sceneChanged(request, updated.restart);
  publishStats();
}

void SceneRunner::apply(const Request& request, const v1::LoadScene& load) {
  LiveScene wanted;
  if (load.has_name()) {
    wanted.scene = scene::loadShipped(load.name());
    wanted.name = load.name();
  } else {
    wanted.scene = scene::parse(load.text(), "scene");
    refuseForeignFiles(v1::Scene(), wanted.scene);
  }
  source_ = openSource(wanted.scene, threads_);
  atEnd_ = false;
  playing_ = !wanted.scene.playback().paused();
  replaceScene(std::move(wanted));
  publishSnapshot();
  events_->sceneChanged(request, true);
  publishStats();
}

void SceneRunner::advance() {
  atEnd_ = !source_->advance();
  unpublished_ = true;
  const Clock::time_point now = Clock::now();
  pace_.record(now, source_->time());
  // While the last snapshot waits to be drawn, making another would be work for nothing.
  if (!snapshots_.peek()) publishSnapshot();
  if (atEnd_ || now >= nextStats_) publishStats();
}

void SceneRunner::replaceScene(LiveScene scene) {
  scene.steps = source_->plan();
  pace_.setSpeed(scene.scene.playback().speed());
  pace_.restart(Clock::now(), source_->time());
  auto frozen = std::make_shared<const LiveScene>(std::move(scene));
  const std::lock_guard lock(mutex_);
  scene_ = std::move(frozen);
}

void SceneRunner::publishSnapshot() {
  std::unique_ptr<core::ParticleSnapshot> snapshot = source_->snapshot();
  snapshot->sequence = ++snapshotSequence_;
  particleCount_ = snapshot->size();
  snapshots_.put(std::move(snapshot));
  unpublished_ = false;
  if (events_) events_->particlesChanged();
}

void SceneRunner::publishStats() {
  nextStats_ = Clock::now() + kStatsInterval;
  v1::Stats stats = toProto(source_->statistics());
  stats.set_simulation_time(source_->time());
  stats.set_particles(particleCount_);
  stats.set_paused(!playing_ || atEnd_);
  stats.set_real_time_factor(playing_ && !atEnd_ ? pace_.realTimeFactor() : 0);
  stats.set_halted(source_->halted());
  {
    const std::lock_guard lock(mutex_);
    stats_ = stats;
  }
  if (events_) events_->stats(stats);
}

}  // namespace sluice::app
