#include "sluice/app/scene_run.h"

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "sluice/app/to_proto.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"

namespace sluice::app {

namespace {

constexpr double kNoGoal = -std::numeric_limits<double>::infinity();
constexpr double kNoStop = std::numeric_limits<double>::infinity();

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

SceneRun::SceneRun(LiveScene live, int threads, std::uint64_t mostParticles)
    : threads_(threads), mostParticles_(mostParticles), goal_(kNoGoal) {
  // What the operator opens is not bound by what viewers may ask for.
  std::unique_ptr<core::ParticleSource> source = openSource(live.scene, threads_);
  take(std::move(live), std::move(source));
}

SceneRun::Outcome SceneRun::apply(const SceneCommand& command) {
  return std::visit([&](const auto& c) { return apply(c); }, command);
}

bool SceneRun::advance() {
  atEnd_ = !source_->advance();
  ++steps_;
  if (hasGoal() && (atEnd_ || source_->time() >= goal_)) setGoal(kNoGoal);
  return !atEnd_;
}

bool SceneRun::hasGoal() const { return goal_ != kNoGoal; }

void SceneRun::setGoal(double seconds) {
  goal_ = seconds;
  source_->stopAt(seconds == kNoGoal ? kNoStop : seconds);
}

void SceneRun::reset() {
  source_->reset();
  atEnd_ = false;
  steps_ = 0;
}

SceneRun::Outcome SceneRun::apply(const v1::Control& control) {
  setGoal(kNoGoal);
  switch (control.action()) {
    case v1::Control::PLAY:
      if (atEnd_ && source_->halted().empty()) reset();
      atEnd_ = false;
      playing_ = true;
      return {};
    case v1::Control::PAUSE:
      playing_ = false;
      return {};
    case v1::Control::STEP:
      playing_ = false;
      if (control.until_seconds() == 0) {
        advance();
      } else if (control.until_seconds() > source_->time() && !atEnd_) {
        setGoal(control.until_seconds());
      }
      return {};
    case v1::Control::RESET:
      reset();
      return {.sceneChanged = false, .restarted = true};
    default:
      throw core::InputError("", "control.action", "is none of PLAY, PAUSE, STEP, RESET");
  }
}

SceneRun::Outcome SceneRun::apply(const v1::UpdateScene& update) {
  scene::Update updated = scene::applyUpdate(live_->scene, update.scene(), update.mask());
  refuseForeignFiles(live_->scene, updated.scene);
  LiveScene next{std::move(updated.scene), live_->name, {}};
  if (updated.restart) {
    std::unique_ptr<core::ParticleSource> source = openSource(next.scene, threads_, mostParticles_);
    const bool playing = playing_;
    take(std::move(next), std::move(source));
    playing_ = playing;
  } else {
    source_->update(next.scene);
    publish(std::move(next));
  }
  return {.sceneChanged = true, .restarted = updated.restart};
}

SceneRun::Outcome SceneRun::apply(const v1::LoadScene& load) {
  LiveScene wanted;
  if (load.has_name()) {
    wanted.scene = scene::loadShipped(load.name());
    wanted.name = load.name();
  } else {
    wanted.scene = scene::parse(load.text(), "scene");
    refuseForeignFiles(v1::Scene(), wanted.scene);
  }
  std::unique_ptr<core::ParticleSource> source = openSource(wanted.scene, threads_, mostParticles_);
  take(std::move(wanted), std::move(source));
  return {.sceneChanged = true, .restarted = true};
}

SceneRun::Outcome SceneRun::apply(const v1::Interact& interact) {
  source_->interact(fromProto(interact));
  return {.particlesAdded = interact.action() == v1::Interact::ADD};
}

void SceneRun::take(LiveScene live, std::unique_ptr<core::ParticleSource> source) {
  source_ = std::move(source);
  atEnd_ = false;
  steps_ = 0;
  goal_ = kNoGoal;
  playing_ = !live.scene.playback().paused();
  publish(std::move(live));
}

void SceneRun::publish(LiveScene live) {
  live.steps = source_->plan();
  live_ = std::make_shared<const LiveScene>(std::move(live));
}

}  // namespace sluice::app
