#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "sluice/app/rate_control.h"
#include "sluice/core/camera.h"
#include "sluice/core/frame.h"
#include "sluice/encode/frame_encoder.h"
#include "sluice/stream/backend.h"

namespace sluice::app {

/// One run of encoded frames: viewers that are sent the pictures of the same viewer and asked for the same encoding
/// share one, so that it is encoded once.
struct StreamKey {
  core::ViewerId owner = 0;  ///< Whose camera it is.
  core::Codec codec = core::Codec::Jpeg;
  v1::QualityMode mode = v1::AUTOMATIC;
  int quality = 0;
  int kilobitsPerSecond = 0;
  bool fullChroma = false;
  core::ViewerId apart = 0;  ///< Not 0: this viewer alone, which cannot keep up with the others.

  auto operator<=>(const StreamKey&) const = default;
};

/// Decides which picture is drawn next and whom it goes to: only what changed, only to viewers that keep up, never
/// faster than they asked for, and with fair shares of the time to draw. Holds no thread, lock or clock; its owner
/// guards it.
class ViewerSchedule {
 public:
  using Clock = std::chrono::steady_clock;

  /// A picture in one encoding.
  struct Encoding {
    std::optional<StreamKey> stream;  ///< None: a picture by itself, which leaves every stream as it is.
    encode::EncoderSettings settings;
    bool keyframe = false;
    std::vector<core::Delivery> deliveries;
  };

  /// One picture to draw.
  struct Job {
    core::ViewerId owner = 0;
    core::Camera camera;
    core::ImageSize size;
    bool still = false;
    std::vector<Encoding> encodings;
  };

  /// What a viewer sees now.
  struct Seen {
    core::Camera camera;
    core::ImageSize size;
  };

  /// `maxWindow` is the number of frames that may be under way to one viewer, from drawing to acknowledgement.
  explicit ViewerSchedule(std::uint32_t maxWindow) : maxWindow_(maxWindow) {}

  /// How many pictures of one owner may be begun and not encoded; 1 or more, 2 unless set.
  ///
  /// With 2 one is drawn while the other is encoded: right where drawing and encoding use different hardware. Where the
  /// same processor does both, neither gets done sooner by that and the second picture shows older input than it could:
  /// 1 encodes a picture before the next is begun.
  void setPipelineDepth(int depth);

  void join(core::ViewerId viewer, const core::Camera& camera);
  void leave(core::ViewerId viewer);
  std::size_t size() const { return viewers_.size(); }
  bool contains(core::ViewerId viewer) const { return viewers_.contains(viewer); }

  /// Throws core::InputError where it is to follow nobody there is, or one that follows it.
  void setView(core::ViewerId viewer, std::uint64_t sequence, const stream::View& view, Clock::time_point now);
  void setCamera(core::ViewerId viewer, std::uint64_t sequence, const core::Camera& camera, Clock::time_point now);
  void acknowledge(core::ViewerId viewer, std::uint64_t frameId, Clock::time_point now);
  void requestKeyframe(core::ViewerId viewer);

  /// False where the viewer has a snapshot waiting already.
  bool requestSnapshot(core::ViewerId viewer, std::uint64_t sequence, core::ImageSize size,
                       const std::optional<core::Camera>& camera);

  /// Everyone's picture is out of date: the particles or the look changed.
  void contentChanged();

  /// As contentChanged, and the picture for `viewer` will reflect its message `sequence`.
  void contentChangedBy(core::ViewerId viewer, std::uint64_t sequence, Clock::time_point now);

  /// Cameras of viewers that never sent one start here when a scene is loaded.
  void setStartCamera(const core::Camera& camera);

  /// The job to do at `now`, marked as begun; none when every picture is up to date, under way or not yet due.
  std::optional<Job> next(Clock::time_point now);

  /// When a job that waits only for time becomes due.
  std::optional<Clock::time_point> nextDue(Clock::time_point now) const;

  // What becomes of a job.

  /// Drawing it took so long.
  void drawn(const Job& job, double seconds);
  /// It could not be drawn.
  void failed(const Job& job);
  /// All of its encodings are done; the next but one of its owner may begin.
  void encoded(core::ViewerId owner);
  /// A frame of it has gone out, or, where `taken` is false, never will.
  void sent(const core::Delivery& delivery, const core::EncodedFrame& frame, bool taken, Clock::time_point now);

  /// It will not go out: encoding it failed. Only the next change makes another.
  void unsent(const core::Delivery& delivery);

  std::optional<Seen> seenBy(core::ViewerId viewer) const;

  /// Whose pictures a viewer is sent, its own id where they are its own; 0 for no viewer.
  core::ViewerId ownerOf(core::ViewerId viewer) const;

  /// The streams that there are viewers for.
  std::set<StreamKey> streams() const;

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
    bool exact = false;  ///< What it was sent last shows the picture without loss.
    std::uint64_t reflectsSequence = 0;
    std::optional<Clock::time_point> askedAt;  ///< When that message came, until a frame shows it.
    std::uint64_t lastFrameId = 0;
    std::uint64_t acknowledgedId = 0;
    Clock::time_point lastJob{};
    std::optional<Clock::time_point> blockedSince;  ///< Its stream waits for it alone.
    bool needsKeyframe = true;
    bool apart = false;
    double served = 0;  ///< Time that was spent on drawing for it, s, with what it left unused counted as used.
    std::optional<Snapshot> snapshot;
    RateController rate;
  };
  struct Member {
    core::ViewerId id;
    Viewer* viewer;
  };
  using Streams = std::map<StreamKey, std::vector<Member>>;

  Viewer* find(core::ViewerId viewer);
  void markStale(core::ViewerId owner);
  StreamKey keyOf(core::ViewerId id, const Viewer& viewer) const;
  Streams membersOfStreams();
  bool windowOpen(const Viewer& viewer) const;
  Clock::time_point earliest(const Viewer& viewer) const;
  bool pipelineFull(core::ViewerId owner) const;
  void partFromSlow(Streams& streams, Clock::time_point now);
  std::vector<Member> due(const StreamKey& key, const std::vector<Member>& members, Clock::time_point now) const;
  core::ImageSize pictureSize(core::ViewerId owner, const Viewer& lead, double scale) const;
  bool dueForStill(core::ViewerId id, const Viewer& viewer, Clock::time_point now) const;
  Clock::time_point stillAt(const Viewer& viewer) const;

  Job snapshotFor(const Member& member);
  Job stillFor(core::ViewerId owner, Clock::time_point now);
  Job frameFor(const Streams& streams, const StreamKey& chosen, Clock::time_point now);
  Encoding encodingFor(const StreamKey& key, const std::vector<Member>& members, Clock::time_point now);
  core::Delivery deliver(const Member& member, Clock::time_point now);

  std::uint32_t maxWindow_;
  int pipelineDepth_ = 2;
  std::map<core::ViewerId, Viewer> viewers_;
  std::map<core::ViewerId, int> inPipeline_;  ///< Jobs of each owner that are begun and not encoded.
  double virtualTime_ = 0;                    ///< Of start-time fair queueing, s.
};

}  // namespace sluice::app
