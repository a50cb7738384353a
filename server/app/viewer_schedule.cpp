#include "sluice/app/viewer_schedule.h"

#include <algorithm>
#include <utility>

namespace sluice::app {

ViewerSchedule::Viewer* ViewerSchedule::find(core::ViewerId viewer) {
  const auto entry = viewers_.find(viewer);
  return entry == viewers_.end() ? nullptr : &entry->second;
}

void ViewerSchedule::join(core::ViewerId viewer, const core::Camera& camera) { viewers_[viewer].camera = camera; }

void ViewerSchedule::leave(core::ViewerId viewer) { viewers_.erase(viewer); }

void ViewerSchedule::setView(core::ViewerId viewer, std::uint64_t sequence, const stream::View& view) {
  if (Viewer* v = find(viewer)) {
    v->view = view;
    v->stale = true;
    v->reflectsSequence = sequence;
    v->earliestNext = {};
  }
}

void ViewerSchedule::setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera) {
  if (Viewer* v = find(viewer)) {
    v->camera = camera;
    v->hasOwnCamera = true;
    v->stale = true;
    v->reflectsSequence = sequence;
  }
}

void ViewerSchedule::acknowledge(core::ViewerId viewer, std::uint64_t frameId) {
  if (Viewer* v = find(viewer)) v->acknowledgedId = std::clamp(frameId, v->acknowledgedId, v->lastFrameId);
}

bool ViewerSchedule::requestSnapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                                     const std::optional<core::Camera>& camera) {
  Viewer* v = find(viewer);
  if (!v || v->snapshot) return false;
  v->snapshot = Snapshot{sequence, size, camera};
  return true;
}

void ViewerSchedule::contentChanged() {
  for (auto& [id, viewer] : viewers_) viewer.stale = true;
}

void ViewerSchedule::contentChangedBy(core::ViewerId viewer, std::uint64_t sequence) {
  contentChanged();
  if (Viewer* v = find(viewer)) v->reflectsSequence = std::max(v->reflectsSequence, sequence);
}

void ViewerSchedule::setStartCamera(const core::Camera& camera) {
  for (auto& [id, viewer] : viewers_) {
    if (!viewer.hasOwnCamera) viewer.camera = camera;
  }
}

bool ViewerSchedule::waitsForRateAlone(const Viewer& viewer) const {
  return viewer.view && viewer.stale && viewer.lastFrameId - viewer.acknowledgedId < frameWindow_;
}

std::optional<ViewerSchedule::Job> ViewerSchedule::next(Clock::time_point now) {
  Viewer* chosen = nullptr;
  core::ViewerId chosenId = 0;
  for (auto& [id, viewer] : viewers_) {
    const bool due = viewer.snapshot || (waitsForRateAlone(viewer) && viewer.earliestNext <= now);
    // Whoever was served longest ago comes first, so one viewer's appetite cannot starve another.
    if (due && (!chosen || viewer.lastServed < chosen->lastServed)) {
      chosen = &viewer;
      chosenId = id;
    }
  }
  if (!chosen) return std::nullopt;

  chosen->lastServed = now;
  Job job;
  job.viewer = chosenId;
  job.reflectsSequence = chosen->reflectsSequence;
  job.camera = chosen->camera;
  if (chosen->snapshot) {
    const Snapshot snapshot = *std::exchange(chosen->snapshot, std::nullopt);
    job.inReplyTo = snapshot.sequence;
    job.view.size = snapshot.size;
    job.view.codec = core::Codec::Png;
    job.camera = snapshot.camera.value_or(chosen->camera);
    return job;
  }
  job.frameId = ++chosen->lastFrameId;
  job.view = *chosen->view;
  chosen->stale = false;
  chosen->earliestNext =
      now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / chosen->view->maxRate));
  return job;
}

std::optional<ViewerSchedule::Clock::time_point> ViewerSchedule::nextDue() const {
  std::optional<Clock::time_point> due;
  for (const auto& [id, viewer] : viewers_) {
    if (waitsForRateAlone(viewer) && (!due || viewer.earliestNext < *due)) due = viewer.earliestNext;
  }
  return due;
}

}  // namespace sluice::app
