#include "sluice/app/scene_runner.h"

#include <exception>
#include <new>
#include <string>
#include <utility>

#include <spdlog/spdlog.h>

#include "sluice/app/to_proto.h"

namespace sluice::app {

namespace {

/// Requests that may wait for the runner's attention; a step seldom takes longer than a slider's burst.
constexpr std::size_t kMaxWaiting = 256;

constexpr std::chrono::milliseconds kStatsInterval{250};

}  // namespace

SceneRunner::SceneRunner(LiveScene scene, const SceneRunnerOptions& options)
    : run_(std::move(scene), options.threads, options.mostParticles) {
  if (options.commandLog) log_.emplace(*options.commandLog, run_.scene()->scene);
  showScene();
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
  if (!thread_.joinable()) return;
  thread_.join();
  if (!log_) return;
  try {
    log_->finish(run_.steps(), *run_.source().snapshot());
  } catch (const core::InputError& error) {
    spdlog::error("{}", error.what());
  }
}

SceneRunner::Enqueued SceneRunner::enqueue(const Request& request, SceneCommand command) {
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

bool SceneRunner::canMove() const { return (run_.playing() || run_.hasGoal()) && !run_.atEnd() && audience_ > 0; }

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
    Clock::time_point due = Clock::time_point::max();
    // What was asked for by its time is wanted soon; what plays keeps its pace.
    if (moving) due = run_.hasGoal() ? now : pace_.due(now, run_.source().time());
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

void SceneRunner::execute(const Request& request, const SceneCommand& command) {
  try {
    carryOut(request, command);
  } catch (const core::InputError& error) {
    events_->failed(request, error);
  } catch (const std::bad_alloc&) {
    events_->failed(request, core::InputError("", "", "the server has not enough memory for this"));
  }
}

void SceneRunner::carryOut(const Request& request, const SceneCommand& command) {
  const std::uint64_t before = run_.steps();
  const SceneRun::Outcome outcome = run_.apply(command);
  log(before, command);

  // A goal that this command has done away with is not reached any more.
  if (waitsForGoal_ && !run_.hasGoal()) {
    events_->failed(*std::exchange(waitsForGoal_, std::nullopt),
                    core::InputError("", "control.until_seconds", "another command came before that time was reached"));
  }
  const bool isControl = std::holds_alternative<v1::Control>(command);
  if (isControl && waitsForGoal_) {
    events_->failed(*waitsForGoal_, core::InputError("", "control.until_seconds", "another time is asked for now"));
  }
  const bool waits = isControl && run_.hasGoal();
  if (waits) waitsForGoal_ = request;

  if (outcome.sceneChanged) showScene();
  if (isControl || outcome.restarted) pace_.restart(Clock::now(), run_.source().time());
  if (outcome.restarted || outcome.particlesAdded || run_.steps() > before) publishSnapshot();
  if (outcome.sceneChanged) events_->sceneChanged(request, outcome.restarted);
  if (isControl || outcome.sceneChanged) publishStats();
  if (!waits) events_->done(request);
}

void SceneRunner::log(std::uint64_t afterSteps, const SceneCommand& command) {
  if (!log_) return;
  try {
    log_->append(afterSteps, command);
  } catch (const core::InputError& error) {
    // A full disk must not end the run; a log with a gap would be worse than none.
    spdlog::error("{}; it is given up", error.what());
    log_.reset();
  }
}

void SceneRunner::advance() {
  run_.advance();
  unpublished_ = true;
  const Clock::time_point now = Clock::now();
  pace_.record(now, run_.source().time());
  settleGoal();
  // While the last snapshot waits to be drawn, making another would be work for nothing; and so are those on the way to
  // a time that somebody asked for.
  if (unpublished_ && !run_.hasGoal() && !snapshots_.peek()) publishSnapshot();
  if (run_.atEnd() || now >= nextStats_) publishStats();
}

void SceneRunner::settleGoal() {
  if (!waitsForGoal_ || run_.hasGoal()) return;
  // The state that was asked for is there to be seen before the answer tells so.
  publishSnapshot();
  publishStats();
  const Request request = *std::exchange(waitsForGoal_, std::nullopt);
  if (run_.atEnd()) {
    const std::string halted = run_.source().halted();
    events_->failed(request, core::InputError("", "control.until_seconds",
                                              halted.empty() ? "the run ends before that time" : halted));
  } else {
    events_->done(request);
  }
}

void SceneRunner::showScene() {
  pace_.setSpeed(run_.scene()->scene.playback().speed());
  pace_.restart(Clock::now(), run_.source().time());
  const std::lock_guard lock(mutex_);
  scene_ = run_.scene();
}

void SceneRunner::publishSnapshot() {
  std::unique_ptr<core::ParticleSnapshot> snapshot = run_.source().snapshot();
  snapshot->sequence = ++snapshotSequence_;
  particleCount_ = snapshot->size();
  snapshots_.put(std::move(snapshot));
  unpublished_ = false;
  if (events_) events_->particlesChanged();
}

void SceneRunner::publishStats() {
  nextStats_ = Clock::now() + kStatsInterval;
  const bool moves = (run_.playing() || run_.hasGoal()) && !run_.atEnd();
  v1::Stats stats = toProto(run_.source().statistics(), run_.source().measures());
  stats.set_simulation_time(run_.source().time());
  stats.set_particles(particleCount_);
  stats.set_paused(!run_.playing() || run_.atEnd());
  stats.set_real_time_factor(moves ? pace_.realTimeFactor() : 0);
  stats.set_halted(run_.source().halted());
  {
    const std::lock_guard lock(mutex_);
    stats_ = stats;
  }
  if (events_) events_->stats(stats);
}

}  // namespace sluice::app
