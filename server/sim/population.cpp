#include "population.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "fluid_volumes.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

/// How near new particles may come to others, in spacings: as near as volumes may at the start.
constexpr double kClosest = 0.75;

/// Numbers that particles can have.
constexpr std::uint64_t kMostIds = std::uint64_t{1} << 32;

Float4 toFloat4(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0};
}

Vector3d toVector(const Float4& v) { return {v.x, v.y, v.z}; }

/// Throws where a place before the mouth is too near to the faces of a container that is no plain box.
void checkInEnclosure(const Nozzle& nozzle, const Vector3d& x, const solids::Enclosure& enclosure, double spacing) {
  const double distance = enclosure.distance(x);
  if (distance >= kClearance * spacing) return;
  std::ostringstream problem;
  problem << "particles would pass " << distance << " m inside the container and its planes; the mouth, and what is "
          << "before it up to the support radius, must be one spacing inside, " << spacing << " m";
  throw core::InputError("", nozzle.path() + ".position", problem.str());
}

/// Throws where a particle in the mouth, or one that is just clear of it, is too near to a face or in a body.
void checkMouth(const Nozzle& nozzle, const Container& container, const Bodies& bodies,
                const Discretisation& discretisation) {
  const double clear = discretisation.support / nozzle.speed();
  const double nearest = kClearance * discretisation.spacing;
  for (std::uint32_t k = 0; k < nozzle.largestLayer(); ++k) {
    for (const double seconds : {0.0, clear}) {
      const Vector3d x = nozzle.placeOf(k, seconds, Vector3d::Zero());
      if (container.enclosure) {
        checkInEnclosure(nozzle, x, *container.enclosure, discretisation.spacing);
        continue;
      }
      for (std::size_t axis = 0; axis < container.walledAxes(); ++axis) {
        const double at = x[static_cast<Eigen::Index>(axis)];
        if (at >= nearest && at <= container.size[axis] - nearest) continue;
        std::ostringstream problem;
        problem << "particles would pass "
                << "xyz"[axis] << " = " << container.origin[axis] + at
                << " m; the mouth, and what is before it up to the support radius of " << discretisation.support
                << " m, must be one spacing inside the container's faces, within ["
                << container.origin[axis] + discretisation.spacing << ", "
                << container.origin[axis] + container.size[axis] - discretisation.spacing << "] m";
        throw core::InputError("", nozzle.path() + ".position", problem.str());
      }
    }
    const auto body =
        bodies.fixedBodyAt(nozzle.placeOf(k, 0, Vector3d::Zero()), kStartingDistance * discretisation.spacing);
    if (!body) continue;
    throw core::InputError("", nozzle.path() + ".position",
                           "the mouth lies inside " + bodies.nameOf(*body) +
                               ", or nearer than half a spacing to its surface: nothing could come out");
  }
}

Eigen::AlignedBox3f drainBox(const v1::Drain& drain, const std::string& path, const Container& container) {
  const Vector3d origin = Vector3d::Map(container.origin.data());
  const Vector3d low = scene::toVector(drain.box().min()) - origin;
  const Vector3d high = scene::toVector(drain.box().max()) - origin;
  for (std::size_t axis = 0; axis < container.walledAxes(); ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    if (high[a] > 0 && low[a] < container.size[axis]) continue;
    throw core::InputError("", path + ".box", "lies outside the container: no particle ever comes there");
  }
  return {low.cast<float>(), high.cast<float>()};
}

/// Places of particles, by chunks in order.
struct Places {
  std::vector<Float4> all;
  Places& operator+=(const Places& other) {
    all.insert(all.end(), other.all.begin(), other.all.end());
    return *this;
  }
};

struct Count {
  std::size_t value = 0;
  Count& operator+=(const Count& other) {
    value += other.value;
    return *this;
  }
};

}  // namespace

Population::Population(const v1::Simulation& simulation, const Container& container, const Bodies& bodies,
                       const MovingBodies& movingBodies, const Discretisation& discretisation)
    : bodies_(&bodies),
      movingBodies_(&movingBodies),
      spacing_(discretisation.spacing),
      support_(discretisation.support) {
  for (int f = 0; f < simulation.fluids_size(); ++f) {
    for (int k = 0; k < simulation.fluids(f).emitters_size(); ++k) {
      const std::string path = "simulation.fluids[" + std::to_string(f) + "].emitters[" + std::to_string(k) + "]";
      nozzles_.emplace_back(simulation.fluids(f).emitters(k), f, path, container, spacing_);
      checkMouth(nozzles_.back(), container, bodies, discretisation);
    }
  }
  for (int k = 0; k < simulation.drains_size(); ++k) {
    drains_.push_back(drainBox(simulation.drains(k), "simulation.drains[" + std::to_string(k) + "]", container));
  }
}

bool Population::isOver(std::size_t nozzle, double time) const {
  const PopulationState::Flow& flow = state_.flows[nozzle];
  const double next = std::max(time, flow.anchor + static_cast<double>(flow.sinceAnchor) * nozzles_[nozzle].interval());
  return flow.given >= nozzles_[nozzle].most() || next > nozzles_[nozzle].end() || state_.nextId >= kMostIds;
}

bool Population::emitting(double time) const {
  if (!state_.held.empty()) return true;
  for (std::size_t k = 0; k < nozzles_.size(); ++k) {
    if (!isOver(k, time)) return true;
  }
  return false;
}

void Population::reset(ParticleState particle, std::uint64_t particles) {
  particle_ = std::move(particle);
  state_ = {};
  state_.nextId = particles;
  for (const Nozzle& nozzle : nozzles_) {
    PopulationState::Flow flow;
    flow.anchor = nozzle.start();
    state_.flows.push_back(flow);
  }
}

void Population::drain(ParticleState& particles, const Team& team) {
  const auto leaves = [&](const Float4& x) {
    const Eigen::Vector3f place(x.x, x.y, x.z);
    return std::ranges::any_of(drains_, [&](const Eigen::AlignedBox3f& box) { return box.contains(place); });
  };
  const auto leaving = team.sumOverChunks<Count>(particles.size(), [&](const Chunk& chunk) {
    Count part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) part.value += leaves(particles.position[i]) ? 1 : 0;
    return part;
  });
  if (leaving.value == 0) return;
  std::vector<std::uint32_t> kept;
  kept.reserve(particles.size() - leaving.value);
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    if (!leaves(particles.position[i])) kept.push_back(i);
  }
  particles.keep(kept);
  state_.drained += leaving.value;
}

double Population::emit(ParticleState& particles, const Moment& moment, const Team& team) {
  letGoAtBodies(moment);
  double fastest = moveHeld(particles, moment, team);
  for (std::size_t k = 0; k < nozzles_.size(); ++k) {
    while (emitLayer(k, particles, moment, team)) {
      const double seconds = moment.time - state_.held.back().mouthSeconds;
      fastest = std::max({fastest, nozzles_[k].speed(), nozzles_[k].velocityAfter(seconds, moment.gravity).norm()});
    }
  }
  letGo(moment.time);
  return fastest;
}

double Population::moveHeld(ParticleState& particles, const Moment& moment, const Team& team) const {
  if (state_.held.empty()) return 0;
  const std::uint32_t first = state_.held.front().firstId;
  team.forEachChunk(particles.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const std::uint32_t id = particles.id[i];
      if (id < first) continue;
      const auto after = std::ranges::upper_bound(state_.held, id, {}, &PopulationState::Layer::firstId);
      const PopulationState::Layer& layer = *(after - 1);
      if (id - layer.firstId >= layer.count) continue;
      const Nozzle& nozzle = nozzles_[layer.nozzle];
      const double seconds = moment.time - layer.mouthSeconds;
      particles.position[i] = toFloat4(nozzle.placeOf(id - layer.firstId, seconds, moment.gravity));
      particles.velocity[i] = toFloat4(nozzle.velocityAfter(seconds, moment.gravity));
    }
  });
  double fastest = 0;
  for (const PopulationState::Layer& layer : state_.held) {
    const double seconds = moment.time - layer.mouthSeconds;
    fastest = std::max(fastest, nozzles_[layer.nozzle].velocityAfter(seconds, moment.gravity).norm());
  }
  return fastest;
}

/// Adds the next layer of a nozzle, if it has passed the mouth by now. Returns whether it did.
bool Population::emitLayer(std::size_t nozzle, ParticleState& particles, const Moment& moment, const Team& team) {
  const Nozzle& from = nozzles_[nozzle];
  PopulationState::Flow& flow = state_.flows[nozzle];
  if (flow.waits != 0) {
    flow.anchor = std::max(moment.time, from.start());
    flow.sinceAnchor = 0;
  }
  const double passes = flow.anchor + static_cast<double>(flow.sinceAnchor) * from.interval();
  if (passes > moment.time || isOver(nozzle, passes)) return false;

  const double seconds = moment.time - passes;
  const std::uint64_t left = std::min(from.most() - flow.given, kMostIds - state_.nextId);
  const auto count = static_cast<std::uint32_t>(std::min<std::uint64_t>(from.layerSize(flow.layers), left));
  std::vector<Float4> places;
  for (std::uint32_t k = 0; k < count; ++k) places.push_back(toFloat4(from.placeOf(k, seconds, moment.gravity)));
  const Vector3d middle = from.placeOf(0, seconds, moment.gravity);
  // 2: the outermost particles of a packing may stick out of the circle by about one spacing.
  const double radius = from.radius() + 2 * spacing_;
  flow.waits = particles.size() + count > moment.most || !hasRoom(places, middle, radius, particles, team) ? 1 : 0;
  if (flow.waits != 0) return false;

  const std::size_t before = particles.size();
  particles.append(particle_, count);
  const Float4 velocity = toFloat4(from.velocityAfter(seconds, moment.gravity));
  for (std::uint32_t k = 0; k < count; ++k) {
    particles.position[before + k] = places[k];
    particles.velocity[before + k] = velocity;
    particles.id[before + k] = static_cast<std::uint32_t>(state_.nextId + k);
    particles.born[before + k] = passes;
    if (!particles.fluid.empty()) particles.fluid[before + k] = static_cast<std::uint8_t>(from.fluid());
  }
  state_.held.push_back({passes, static_cast<std::uint32_t>(state_.nextId), count, nozzle});
  state_.nextId += count;
  flow.given += count;
  ++flow.layers;
  ++flow.sinceAnchor;
  return true;
}

bool Population::hasRoom(const std::vector<Float4>& places, const Vector3d& middle, double radius,
                         const ParticleState& particles, const Team& team) const {
  if (std::ranges::any_of(places, [&](const Float4& place) { return isBlocked(toVector(place)); })) return false;
  const double reach = radius + kClosest * spacing_;
  const auto near = team.sumOverChunks<Places>(particles.size(), [&](const Chunk& chunk) {
    Places part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Float4& x = particles.position[i];
      if ((toVector(x) - middle).squaredNorm() < reach * reach) part.all.push_back(x);
    }
    return part;
  });
  const double closest = kClosest * spacing_;
  return std::ranges::none_of(near.all, [&](const Float4& x) {
    return std::ranges::any_of(
        places, [&](const Float4& place) { return (toVector(x) - toVector(place)).squaredNorm() < closest * closest; });
  });
}

/// Whether there is a body now where a particle would be.
bool Population::isBlocked(const Vector3d& place) const {
  const double distance = kStartingDistance * spacing_;
  return bodies_->anyStandsAt(place, distance) || movingBodies_->anyAt(place, distance);
}

/// Leaves layers to the solver, where the last step's move has left them, that would be moved on into a body, and those
/// that come behind them from the same nozzle.
void Population::letGoAtBodies(const Moment& moment) {
  if (bodies_->empty() && movingBodies_->empty()) return;
  std::vector<bool> stopped(nozzles_.size(), false);
  std::erase_if(state_.held, [&](const PopulationState::Layer& layer) {
    const Nozzle& nozzle = nozzles_[layer.nozzle];
    const double seconds = moment.time - layer.mouthSeconds;
    for (std::uint32_t k = 0; k < layer.count && !stopped[layer.nozzle]; ++k) {
      stopped[layer.nozzle] = isBlocked(nozzle.placeOf(k, seconds, moment.gravity));
    }
    return stopped[layer.nozzle];
  });
}

/// Leaves layers to the solver that have come far enough.
void Population::letGo(double time) {
  std::erase_if(state_.held, [&](const PopulationState::Layer& layer) {
    return (time - layer.mouthSeconds) * nozzles_[layer.nozzle].speed() >= support_;
  });
}

std::uint64_t Population::numbersLeft() const { return kMostIds - state_.nextId; }

std::uint32_t Population::takeNumbers(std::uint64_t count) {
  SLUICE_CHECK(count <= numbersLeft());
  const auto first = static_cast<std::uint32_t>(state_.nextId);
  state_.nextId += count;
  return first;
}

std::uint64_t Population::emitted() const {
  std::uint64_t total = 0;
  for (const PopulationState::Flow& flow : state_.flows) total += flow.given;
  return total;
}

void Population::save(core::StateWriter& out) const {
  out.write(state_.flows);
  out.write(state_.held);
  out.write(state_.nextId);
  out.write(state_.drained);
}

void Population::resume(core::StateReader& in, const std::vector<std::uint32_t>& ids) {
  PopulationState saved;
  in.read(saved.flows);
  in.read(saved.held);
  in.read(saved.nextId);
  in.read(saved.drained);
  bool fits = saved.flows.size() == nozzles_.size() && saved.nextId <= kMostIds;
  for (const PopulationState::Flow& flow : saved.flows) fits = fits && std::isfinite(flow.anchor);
  std::uint64_t free = 0;
  for (const PopulationState::Layer& layer : saved.held) {
    fits = fits && layer.firstId >= free && layer.nozzle < nozzles_.size() && std::isfinite(layer.mouthSeconds) &&
           layer.count <= nozzles_[layer.nozzle].largestLayer();
    free = std::uint64_t{layer.firstId} + layer.count;
  }
  fits = fits && free <= saved.nextId;
  std::vector<std::uint32_t> sorted = ids;
  std::ranges::sort(sorted);
  fits = fits && std::ranges::adjacent_find(sorted) == sorted.end() && (ids.empty() || sorted.back() < saved.nextId);
  if (!fits) in.fail("its emitters and drains are not those of the state's scene");
  state_ = std::move(saved);
}

}  // namespace sluice::sim
