// Which picture ViewerSchedule has drawn next, and for whom.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "sluice/app/viewer_schedule.h"

namespace sluice::app {

namespace {

using Clock = ViewerSchedule::Clock;

/// After so long without a change a viewer gets its picture without loss.
constexpr std::chrono::milliseconds kRest{300};

/// How long a stream waits for one of its viewers before it goes on without it, and how long that one then stays apart.
constexpr std::chrono::milliseconds kPatience{100};
constexpr std::chrono::seconds kApart{10};

Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
}

/// Rates that encoders are told: few, since each change may cost a keyframe.
double nominalRate(double framesPerSecond) {
  for (const double rate : std::array{1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0}) {
    if (framesPerSecond <= rate * 1.2) return rate;
  }
  return 60;
}

core::ImageSize scaled(core::ImageSize size, double scale) {
  const auto edge = [&](int pixels) { return std::max(static_cast<int>(std::lround(pixels * scale)), 1); };
  return {edge(size.width), edge(size.height)};
}

/// The owner where it is among them, else the one that joined first.
template <class Members>
const auto& leadOf(const StreamKey& key, const Members& members) {
  const auto owner =
      std::find_if(members.begin(), members.end(), [&](const auto& member) { return member.id == key.owner; });
  return owner != members.end() ? *owner : members.front();
}

}  // namespace

StreamKey ViewerSchedule::keyOf(core::ViewerId id, const Viewer& viewer) const {
  const stream::View& view = *viewer.view;
  return {.owner = ownerOf(id),
          .codec = view.codecs.front(),
          .mode = view.mode,
          .quality = view.quality,
          .kilobitsPerSecond = view.kilobitsPerSecond,
          .fullChroma = view.fullChroma,
          .apart = viewer.apart ? id : 0};
}

ViewerSchedule::Streams ViewerSchedule::membersOfStreams() {
  Streams streams;
  for (auto& [id, viewer] : viewers_) {
    if (viewer.view) streams[keyOf(id, viewer)].push_back({id, &viewer});
  }
  return streams;
}

bool ViewerSchedule::windowOpen(const Viewer& viewer) const {
  return viewer.lastFrameId - viewer.acknowledgedId < viewer.rate.target().window;
}

Clock::time_point ViewerSchedule::earliest(const Viewer& viewer) const {
  return viewer.lastJob == Clock::time_point{} ? Clock::time_point{}
                                               : viewer.lastJob + seconds(1 / viewer.rate.target().framesPerSecond);
}

bool ViewerSchedule::pipelineFull(core::ViewerId owner) const {
  const auto entry = inPipeline_.find(owner);
  return entry != inPipeline_.end() && entry->second >= pipelineDepth_;
}

void ViewerSchedule::partFromSlow(Streams& streams, Clock::time_point now) {
  bool parted = false;
  for (auto& [key, members] : streams) {
    if (!core::isVideo(key.codec)) continue;
    for (const Member& member : members) {
      Viewer& viewer = *member.viewer;
      if (viewer.apart && now - *viewer.blockedSince > kApart) {
        viewer.apart = false;
        viewer.needsKeyframe = parted = true;
        viewer.blockedSince.reset();
      }
    }
    if (members.size() < 2) continue;
    const bool othersWait = std::any_of(members.begin(), members.end(), [&](const Member& member) {
      return member.viewer->stale && windowOpen(*member.viewer);
    });
    for (const Member& member : members) {
      Viewer& viewer = *member.viewer;
      if (!othersWait || windowOpen(viewer)) {
        viewer.blockedSince.reset();
        continue;
      }
      if (!viewer.blockedSince) viewer.blockedSince = now;
      if (now - *viewer.blockedSince < kPatience) continue;
      viewer.apart = viewer.needsKeyframe = parted = true;
      viewer.blockedSince = now;
    }
  }
  if (parted) streams = membersOfStreams();
}

std::vector<ViewerSchedule::Member> ViewerSchedule::due(const StreamKey& key, const std::vector<Member>& members,
                                                        Clock::time_point now) const {
  if (pipelineFull(key.owner)) return {};
  const Viewer& lead = *leadOf(key, members).viewer;
  if (!core::isVideo(key.codec)) {
    std::vector<Member> ready;
    std::copy_if(members.begin(), members.end(), std::back_inserter(ready),
                 [&](const Member& member) { return member.viewer->stale && windowOpen(*member.viewer); });
    if (lead.stale && windowOpen(lead)) return earliest(lead) <= now ? ready : std::vector<Member>();
    // Who missed the lead's last picture gets its next; a picture of their own only when none comes.
    return lead.lastJob + kPatience <= now ? ready : std::vector<Member>();
  }
  // A frame of video builds on the last one, so it goes to all of the stream or to none.
  const bool stale = std::any_of(members.begin(), members.end(), [](const Member& m) { return m.viewer->stale; });
  const bool open = std::all_of(members.begin(), members.end(), [&](const Member& m) { return windowOpen(*m.viewer); });
  if (!stale || !open || earliest(lead) > now) return {};
  return members;
}

core::ImageSize ViewerSchedule::pictureSize(core::ViewerId owner, const Viewer& lead, double scale) const {
  const Viewer& eye = viewers_.at(owner);
  return scaled(eye.view ? eye.view->size : lead.view->size, scale);
}

core::Delivery ViewerSchedule::deliver(const Member& member, Clock::time_point now) {
  Viewer& viewer = *member.viewer;
  viewer.stale = false;
  viewer.lastJob = now;
  viewer.served = std::max(viewer.served, virtualTime_);
  return {.viewer = member.id,
          .frameId = ++viewer.lastFrameId,
          .reflectsSequence = viewer.reflectsSequence,
          .inReplyTo = 0,
          .askedAt = std::exchange(viewer.askedAt, std::nullopt)};
}

ViewerSchedule::Encoding ViewerSchedule::encodingFor(const StreamKey& key, const std::vector<Member>& members,
                                                     Clock::time_point now) {
  const RateTarget& target = leadOf(key, members).viewer->rate.target();
  Encoding encoding{.stream = key, .settings = {}, .keyframe = false, .deliveries = {}};
  encoding.settings = {.codec = key.codec,
                       .quality = target.quality,
                       .fullChroma = key.fullChroma,
                       .kilobitsPerSecond = target.kilobitsPerSecond,
                       .constantBitRate = key.mode == v1::FIXED_BIT_RATE,
                       .frameRate = nominalRate(target.framesPerSecond)};
  for (const Member& member : members) {
    encoding.keyframe = std::exchange(member.viewer->needsKeyframe, false) || encoding.keyframe;
    member.viewer->exact = key.codec == core::Codec::Png && target.scale == 1;
    encoding.deliveries.push_back(deliver(member, now));
  }
  return encoding;
}

Clock::time_point ViewerSchedule::stillAt(const Viewer& viewer) const { return viewer.lastJob + kRest; }

bool ViewerSchedule::dueForStill(core::ViewerId id, const Viewer& viewer, Clock::time_point now) const {
  return viewer.view && viewer.view->stills && !viewer.stale && !viewer.exact && viewer.lastFrameId > 0 &&
         viewer.acknowledgedId == viewer.lastFrameId && now >= stillAt(viewer) && !inPipeline_.contains(ownerOf(id));
}

std::optional<ViewerSchedule::Job> ViewerSchedule::next(Clock::time_point now) {
  Streams streams = membersOfStreams();
  partFromSlow(streams, now);

  // Whoever has had the least of the drawing time comes first, so one viewer's appetite cannot starve another; among
  // equals, whoever was served longest ago.
  struct Candidate {
    double tag;
    Clock::time_point last;
    std::function<Job()> make;
  };
  std::optional<Candidate> best;
  const auto offer = [&](const Viewer& viewer, std::function<Job()> make) {
    const double tag = std::max(viewer.served, virtualTime_);
    if (best && std::pair(best->tag, best->last) <= std::pair(tag, viewer.lastJob)) return;
    best = {tag, viewer.lastJob, std::move(make)};
  };
  for (auto& [id, viewer] : viewers_) {
    if (viewer.snapshot) offer(viewer, [this, member = Member{id, &viewer}] { return snapshotFor(member); });
    if (dueForStill(id, viewer, now)) offer(viewer, [this, owner = ownerOf(id), now] { return stillFor(owner, now); });
  }
  for (const auto& [key, members] : streams) {
    const std::vector<Member> ready = due(key, members, now);
    if (ready.empty()) continue;
    const auto least = std::min_element(ready.begin(), ready.end(), [](const Member& a, const Member& b) {
      return a.viewer->served < b.viewer->served;
    });
    offer(*least->viewer, [this, &streams, &key = key, now] { return frameFor(streams, key, now); });
  }
  if (!best) return std::nullopt;
  virtualTime_ = best->tag;
  return best->make();
}

ViewerSchedule::Job ViewerSchedule::snapshotFor(const Member& member) {
  Viewer& viewer = *member.viewer;
  const Snapshot snapshot = *std::exchange(viewer.snapshot, std::nullopt);
  viewer.served = std::max(viewer.served, virtualTime_);
  Job job{.owner = ownerOf(member.id),
          .camera = snapshot.camera.value_or(viewers_.at(ownerOf(member.id)).camera),
          .size = snapshot.size,
          .still = false,
          .encodings = {}};
  Encoding encoding;
  encoding.settings.codec = core::Codec::Png;
  encoding.deliveries.push_back({.viewer = member.id,
                                 .frameId = 0,
                                 .reflectsSequence = viewer.reflectsSequence,
                                 .inReplyTo = snapshot.sequence,
                                 .askedAt = {}});
  job.encodings.push_back(std::move(encoding));
  ++inPipeline_[job.owner];
  return job;
}

ViewerSchedule::Job ViewerSchedule::stillFor(core::ViewerId owner, Clock::time_point now) {
  Job job{.owner = owner, .camera = viewers_.at(owner).camera, .size = {}, .still = true, .encodings = {}};
  Encoding encoding;
  encoding.settings.codec = core::Codec::Png;
  for (auto& [id, viewer] : viewers_) {
    if (ownerOf(id) != owner || !dueForStill(id, viewer, now)) continue;
    if (encoding.deliveries.empty()) job.size = pictureSize(owner, viewer, 1);
    encoding.deliveries.push_back(deliver({id, &viewer}, now));
    viewer.exact = true;
  }
  job.encodings.push_back(std::move(encoding));
  ++inPipeline_[owner];
  return job;
}

ViewerSchedule::Job ViewerSchedule::frameFor(const Streams& streams, const StreamKey& chosen, Clock::time_point now) {
  Job job{
      .owner = chosen.owner, .camera = viewers_.at(chosen.owner).camera, .size = {}, .still = false, .encodings = {}};
  const auto sizeOf = [&](const StreamKey& key, const std::vector<Member>& members) {
    const Viewer& lead = *leadOf(key, members).viewer;
    return pictureSize(key.owner, lead, lead.rate.target().scale);
  };
  job.size = sizeOf(chosen, streams.at(chosen));
  // Everybody who is to see the same picture gets it now, in whatever encoding.
  for (const auto& [key, members] : streams) {
    if (key.owner != chosen.owner || sizeOf(key, members) != job.size) continue;
    const std::vector<Member> ready = due(key, members, now);
    if (!ready.empty()) job.encodings.push_back(encodingFor(key, ready, now));
  }
  ++inPipeline_[job.owner];
  return job;
}

std::optional<Clock::time_point> ViewerSchedule::nextDue(Clock::time_point now) const {
  std::optional<Clock::time_point> soonest;
  const auto offer = [&](Clock::time_point when) {
    if (when > now && (!soonest || when < *soonest)) soonest = when;
  };
  const bool stale = std::any_of(viewers_.begin(), viewers_.end(), [](const auto& v) { return v.second.stale; });
  for (const auto& [id, viewer] : viewers_) {
    if (!viewer.view) continue;
    // A stream goes at the pace of its lead, whose own picture need not be the one that is out of date.
    if (stale && windowOpen(viewer) && !pipelineFull(ownerOf(id))) {
      offer(earliest(viewer));
      offer(viewer.lastJob + kPatience);
    }
    if (!viewer.stale && !viewer.exact && viewer.view->stills) offer(stillAt(viewer));
    if (viewer.blockedSince) offer(*viewer.blockedSince + (viewer.apart ? Clock::duration(kApart) : kPatience));
  }
  return soonest;
}

}  // namespace sluice::app
