#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>

#include "sluice/core/camera.h"
#include "sluice/core/frame.h"
#include "sluice/stream/backend.h"

namespace sluice::app {

/// Decides which viewer's picture is drawn next: only what changed, only while the viewer keeps up, never faster than
/// it asked for, and fairly. Holds no thread, lock or clock; its owner guards it.
class ViewerSchedule {
 public:
  using Clock = std::chrono::steady_clock;

  /// One picture to draw.
  struct Job {
    core::ViewerId viewer = 0;
    std::uint64_t frameId = 0;
    std::uint64_t reflectsSequence = 0;
    std::uint64_t inReplyTo = 0;  ///< Not 0: a snapshot, outside the window.
    stream::View view;
    core::Camera camera;
  };

  /// `frameWindow` is the number of frames that may be under way to one viewer, from drawing to acknowledgement.
  explicit ViewerSchedule(std::uint32_t frameWindow) : frameWindow_(frameWindow) {}

  void join(core::ViewerId viewer, const core::Camera& camera);
  void leave(core::ViewerId viewer);
  std::size_t size() const { return viewers_.size(); }
  bool contains(core::ViewerId viewer) const { return viewers_.contains(viewer); }

  void setView(core::ViewerId viewer, std::uint64_t sequence, const stream::View& view);
  void setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera);
  void acknowledge(core::ViewerId viewer, std::uint64_t frameId);

  /// False where the viewer has a snapshot waiting already.
  bool requestSnapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                       const std::optional<core::Camera>& camera);

  /// Everyone's picture is out of date: the particles or the look changed.
  void contentChanged();

  /// As contentChanged, and the picture for `viewer` will reflect its message `sequence`.
  void contentChangedBy(core::ViewerId viewer, std::uint64_t sequence);

  /// Cameras of viewers that never sent one start here when a scene is loaded.
  void setStartCamera(const core::Camera& camera);

  /// The job to do at `now`, marked as begun; none when every picture is up to date, under way or not yet due.
  std::optional<Job> next(Clock::time_point now);

  /// When a job that waits only for its viewer's rate becomes due.
  std::optional<Clock::time_point> nextDue() const;

 private:
  struct Snapshot {
    std::uint64_t sequence = 0;
    core::ImageSize size;
    std::optional<core::Camera> camera;
  };
  struct Viewer {
    std::optional<stream::View> view;
    core::Camera camera;
    bool hasOwnCamera = false;
    bool stale = true;
    std::uint64_t reflectsSequence = 0;
    std::uint64_t lastFrameId = 0;
    std::uint64_t acknowledgedId = 0;
    Clock::time_point earliestNext{};  ///< By the viewer's maximum rate.
    Clock::time_point lastServed{};
    std::optional<Snapshot> snapshot;
  };

  Viewer* find(core::ViewerId viewer);
  bool waitsForRateAlone(const Viewer& viewer) const;

  std::uint32_t frameWindow_;
  std::map<core::ViewerId, Viewer> viewers_;
};

}  // namespace sluice::app
