#include "sluice/app/viewer_schedule.h"

#include <algorithm>
#include <string>

#include "sluice/core/check.h"
#include "sluice/core/input_error.h"

namespace sluice::app {

ViewerSchedule::Viewer* ViewerSchedule::find(core::ViewerId viewer) {
  const auto entry = viewers_.find(viewer);
  return entry == viewers_.end() ? nullptr : &entry->second;
}

core::ViewerId ViewerSchedule::ownerOf(core::ViewerId viewer) const {
  // A viewer that is followed may follow another. `setView` lets no circle come about.
  auto entry = viewers_.find(viewer);
  if (entry == viewers_.end()) return 0;
  for (;;) {
    const core::ViewerId next = entry->second.view ? entry->second.view->follow : 0;
    const auto followed = next != 0 ? viewers_.find(next) : viewers_.end();
    if (followed == viewers_.end()) return entry->first;
    entry = followed;
  }
}

void ViewerSchedule::setPipelineDepth(int depth) {
  SLUICE_CHECK(depth >= 1);
  pipelineDepth_ = depth;
}

void ViewerSchedule::join(core::ViewerId viewer, const core::Camera& camera) {
  Viewer& v = viewers_[viewer];
  v.camera = camera;
  v.served = virtualTime_;
  v.rate = RateController(maxWindow_);
}

void ViewerSchedule::leave(core::ViewerId viewer) {
  // Its followers see with their own eyes again.
  markStale(viewer);
  viewers_.erase(viewer);
}

void ViewerSchedule::setView(core::ViewerId viewer, std::uint64_t sequence, const stream::View& view,
                             Clock::time_point now) {
  Viewer* v = find(viewer);
  if (!v) return;
  if (view.follow != 0) {
    const core::ViewerId owner = ownerOf(view.follow);
    const std::string name = std::to_string(view.follow);
    if (owner == 0) throw core::InputError("", "set_view.follow", "there is no viewer " + name);
    if (owner == viewer) throw core::InputError("", "set_view.follow", "viewer " + name + " follows this one");
  }
  v->view = view;
  v->rate.setView(view);
  v->reflectsSequence = sequence;
  v->askedAt = now;
  v->lastJob = {};
  v->needsKeyframe = true;
  v->apart = false;
  // Those who follow it are sent pictures of its size.
  if (view.follow == 0) markStale(viewer);
  v->stale = true;
}

void ViewerSchedule::setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera,
                               Clock::time_point now) {
  Viewer* v = find(viewer);
  if (!v) return;
  v->camera = camera;
  v->hasOwnCamera = true;
  v->reflectsSequence = sequence;
  v->askedAt = now;
  markStale(viewer);
}

void ViewerSchedule::markStale(core::ViewerId owner) {
  for (auto& [id, viewer] : viewers_) {
    if (id == owner || ownerOf(id) == owner) viewer.stale = true;
  }
}

void ViewerSchedule::acknowledge(core::ViewerId viewer, std::uint64_t frameId, Clock::time_point now) {
  Viewer* v = find(viewer);
  if (!v) return;
  v->acknowledgedId = std::clamp(frameId, v->acknowledgedId, v->lastFrameId);
  v->rate.acknowledged(v->acknowledgedId, now);
}

void ViewerSchedule::requestKeyframe(core::ViewerId viewer) {
  if (Viewer* v = find(viewer)) v->needsKeyframe = v->stale = true;
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

void ViewerSchedule::contentChangedBy(core::ViewerId viewer, std::uint64_t sequence, Clock::time_point now) {
  contentChanged();
  Viewer* v = find(viewer);
  if (!v || sequence <= v->reflectsSequence) return;
  v->reflectsSequence = sequence;
  v->askedAt = now;
}

void ViewerSchedule::setStartCamera(const core::Camera& camera) {
  for (auto& [id, viewer] : viewers_) {
    if (!viewer.hasOwnCamera) viewer.camera = camera;
  }
}

void ViewerSchedule::drawn(const Job& job, double seconds) {
  std::size_t count = 0;
  for (const Encoding& encoding : job.encodings) count += encoding.deliveries.size();
  for (const Encoding& encoding : job.encodings) {
    for (const core::Delivery& delivery : encoding.deliveries) {
      Viewer* viewer = find(delivery.viewer);
      if (!viewer) continue;
      viewer->served += seconds / static_cast<double>(count);
      if (encoding.stream) viewer->rate.setDrawSeconds(seconds);
    }
  }
}

void ViewerSchedule::failed(const Job& job) {
  encoded(job.owner);
  for (const Encoding& encoding : job.encodings) {
    // Trying again at once would fail again: the next change does.
    for (const core::Delivery& delivery : encoding.deliveries) unsent(delivery);
  }
}

void ViewerSchedule::encoded(core::ViewerId owner) {
  const auto entry = inPipeline_.find(owner);
  if (entry != inPipeline_.end() && --entry->second <= 0) inPipeline_.erase(entry);
}

void ViewerSchedule::sent(const core::Delivery& delivery, const core::EncodedFrame& frame, bool taken,
                          Clock::time_point now) {
  Viewer* viewer = find(delivery.viewer);
  if (!viewer || delivery.inReplyTo != 0) return;
  if (taken) {
    viewer->rate.sent({.frameId = delivery.frameId,
                       .bytes = frame.bytes.size(),
                       .size = frame.size,
                       .quality = frame.quality,
                       .keyframe = frame.keyframe},
                      now);
    return;
  }
  unsent(delivery);
  viewer->stale = true;
}

void ViewerSchedule::unsent(const core::Delivery& delivery) {
  Viewer* viewer = find(delivery.viewer);
  if (!viewer || delivery.inReplyTo != 0) return;
  // Nobody will acknowledge what is never sent.
  viewer->acknowledgedId = std::max(viewer->acknowledgedId, delivery.frameId);
  viewer->needsKeyframe = true;
}

std::optional<ViewerSchedule::Seen> ViewerSchedule::seenBy(core::ViewerId viewer) const {
  const auto entry = viewers_.find(viewer);
  if (entry == viewers_.end()) return std::nullopt;
  const Viewer& owner = viewers_.at(ownerOf(viewer));
  const std::optional<stream::View>& view = owner.view ? owner.view : entry->second.view;
  return Seen{owner.camera, view ? view->size : core::ImageSize{1, 1}};
}

std::set<StreamKey> ViewerSchedule::streams() const {
  std::set<StreamKey> keys;
  for (const auto& [id, viewer] : viewers_) {
    if (viewer.view) keys.insert(keyOf(id, viewer));
  }
  return keys;
}

}  // namespace sluice::app
