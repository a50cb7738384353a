#include "initial_state.h"

#include <algorithm>
#include <span>
#include <sstream>

#include "fluid_volumes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {

namespace {

using Eigen::Vector3d;

[[noreturn]] void refuseCount(double count, const ParticleLimit& limit, const std::string& path) {
  std::ostringstream problem;
  problem.precision(12);
  problem << "the scene has at least " << count << " particles, " << limit.explain(count);
  throw core::InputError("", path, problem.str());
}

/// Throws before any particle is made where there would be too many.
void checkCount(const v1::Simulation& simulation, const std::vector<FluidVolume>& volumes, const ParticleLimit& limit) {
  if (simulation.fluids_size() == 0) {
    throw core::InputError("", "simulation.fluids", "the scene has no fluid; it needs at least one");
  }
  double total = 0;
  for (const FluidVolume& volume : volumes) {
    total += volume.expected;
    if (total > static_cast<double>(limit.count)) refuseCount(total, limit, volume.path);
  }
}

/// Throws where the scene starts with more particles than it allows itself.
void checkBudget(const v1::Simulation& simulation, const ParticleState& particles) {
  if (particles.size() <= simulation.max_particles()) return;
  throw core::InputError("", "simulation.max_particles",
                         "the scene starts with " + std::to_string(particles.size()) + " particles; allowed are " +
                             std::to_string(simulation.max_particles()) + ": raise this, or the particle_spacing");
}

[[noreturn]] void refuseEmpty(const FluidVolume& volume, const Bodies& bodies, std::optional<std::size_t> body) {
  if (body) {
    throw core::InputError("", volume.path,
                           "the whole " + volume.noun + " lies inside " + bodies.nameOf(*body) +
                               " or another body, or nearer than half a spacing to its surface: nothing is left of it");
  }
  throw core::InputError(
      "", volume.path,
      "the " + volume.noun + " holds no particle: it is too small for the particle_spacing, or outside the container");
}

/// What volumes are laid into.
struct Room {
  const Container& container;
  const Bodies& bodies;
  double spacing;  ///< m.
  const ParticleLimit& limit;
  VolumeFit fit;
};

bool isFilled(std::span<const FluidVolume> volumes, const Vector3d& x, double spacing) {
  return std::ranges::any_of(volumes, [&](const FluidVolume& volume) { return holds(volume, x, spacing); });
}

/// Adds the particles of a volume that bodies and, where it has been refilled, faces and `earlier` volumes leave room
/// for.
void addParticles(const FluidVolume& volume, std::span<const FluidVolume> earlier, const Room& room,
                  InitialState& state) {
  std::vector<Float4>& position = state.particles.position;
  const std::size_t before = position.size();
  std::optional<std::size_t> lastBody;
  bool isFilledAlready = false;
  position.reserve(before + static_cast<std::size_t>(volume.expected));
  forEachPlace(volume, room.spacing, [&](const Vector3d& x) {
    if (room.fit == VolumeFit::AsGiven) {
      checkClear(volume, x, room.container, room.spacing);
    } else if (isFilled(earlier, x, room.spacing)) {
      isFilledAlready = true;
      ++state.misfits;
      return;
    } else if (!isClear(x, room.container, room.spacing)) {
      ++state.misfits;
      return;
    }
    const Eigen::Vector3f rounded = x.cast<float>();
    if (const auto body = room.bodies.bodyAt(rounded.cast<double>(), kStartingDistance * room.spacing)) {
      lastBody = body;
      ++state.takenOut[*body];
      return;
    }
    if (position.size() == room.limit.count) {
      refuseCount(static_cast<double>(room.limit.count) + 1, room.limit, volume.path);
    }
    position.push_back({rounded.x(), rounded.y(), rounded.z(), 0});
  });
  if (position.size() == before && !isFilledAlready) refuseEmpty(volume, room.bodies, lastBody);
}

}  // namespace

const InitialState::Origin& InitialState::originOf(std::uint32_t id) const {
  const auto found = std::ranges::upper_bound(origins, std::uint64_t{id}, {}, &Origin::end);
  return *found;
}

InitialState initialState(const v1::Simulation& simulation, const Container& container, const Bodies& bodies,
                          const ParticleLimit& limit, VolumeFit fit) {
  const Room room{container, bodies, simulation.particle_spacing(), limit, fit};
  const std::vector<FluidVolume> volumes = fluidVolumes(simulation, container);
  checkCount(simulation, volumes, limit);

  InitialState initial;
  initial.takenOut.resize(bodies.size());
  ParticleState& state = initial.particles;
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    const FluidVolume& volume = volumes[k];
    addParticles(volume, std::span(volumes).first(k), room, initial);
    initial.origins.push_back({volume.noun, volume.path, volume.place, state.size()});
    const Float4 velocity{static_cast<float>(volume.velocity.x()), static_cast<float>(volume.velocity.y()),
                          static_cast<float>(volume.velocity.z()), 0};
    state.velocity.resize(state.size(), velocity);
    if (simulation.fluids_size() > 1) state.fluid.resize(state.size(), static_cast<std::uint8_t>(volume.fluid));
  }
  checkBudget(simulation, state);
  state.densityImpulse.resize(state.size());
  state.id.resize(state.size());
  for (std::uint32_t i = 0; i < state.size(); ++i) state.id[i] = i;
  return initial;
}

}  // namespace sluice::sim
