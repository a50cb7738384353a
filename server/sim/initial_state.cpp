#include "initial_state.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "sluice/core/input_error.h"
#include "sluice/scene/convert.h"

namespace sluice::sim {

namespace {

using Triple = std::array<double, 3>;

Triple toTriple(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::array<std::uint64_t, 3> countsOf(const v1::Block& block) {
  return {block.count_x(), block.count_y(), block.count_z()};
}

std::uint64_t particlesOf(const v1::Block& block) {
  // At most 10000³ = 10¹²: no overflow.
  return std::uint64_t{block.count_x()} * block.count_y() * block.count_z();
}

std::string blockPath(int fluid, int block) {
  return "simulation.fluids[" + std::to_string(fluid) + "].blocks[" + std::to_string(block) + "]";
}

constexpr char kAxes[] = "xyz";

/// How far from a body's surface a particle has to start, in spacings: half of one, and what decimal fractions lack.
constexpr double kStartingDistance = 0.495;

/// Throws where a block does not keep its distance from the faces of a container that is no plain box. It is convex:
/// where the block's corners are inside, all of it is.
void checkInEnclosure(const v1::Block& block, const std::string& path, const Container& container, double spacing) {
  const Eigen::Vector3d first = scene::toVector(block.first_particle()) -
                                Eigen::Vector3d(container.origin[0], container.origin[1], container.origin[2]);
  const Eigen::Vector3d extent(block.count_x() - 1.0, block.count_y() - 1.0, block.count_z() - 1.0);
  const Eigen::AlignedBox3d box(first, first + spacing * extent);
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    const double distance = container.enclosure->distance(corner);
    if (distance >= kClearance * spacing) continue;
    std::ostringstream problem;
    problem << "a corner of the block is " << distance << " m inside the container and its planes; particles must "
            << "start one spacing inside, " << spacing << " m";
    throw core::InputError("", path + ".first_particle", problem.str());
  }
}

/// Throws where a block does not keep its distance from the container's faces.
void checkInside(const v1::Block& block, const std::string& path, const Container& container, double spacing) {
  if (container.enclosure) return checkInEnclosure(block, path, container, spacing);
  const Triple first = toTriple(block.first_particle());
  const auto counts = countsOf(block);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = container.origin[axis] + kClearance * spacing;
    const double high = container.origin[axis] + container.size[axis] - kClearance * spacing;
    const double last = first[axis] + spacing * static_cast<double>(counts[axis] - 1);
    if (std::isfinite(first[axis]) && first[axis] >= low && last <= high) continue;
    std::ostringstream problem;
    problem << "the block reaches from " << kAxes[axis] << " = " << first[axis] << " m to " << last
            << " m; particles must start one spacing inside the container's faces, within ["
            << container.origin[axis] + spacing << ", " << container.origin[axis] + container.size[axis] - spacing
            << "] m";
    throw core::InputError("", path + ".first_particle", problem.str());
  }
}

/// Throws where a block of a planar scene is not one layer of particles in the plane of the first, moving within it.
void checkPlanar(const v1::Block& block, const std::string& path, const Container& container) {
  if (block.count_z() != 1) {
    throw core::InputError("", path + ".count_z", "must be 1: the scene is planar");
  }
  if (block.first_particle().z() != container.origin[2] + *container.plane) {
    std::ostringstream problem;
    problem << "the scene is planar: z must be that of the first block, " << container.origin[2] + *container.plane
            << " m";
    throw core::InputError("", path + ".first_particle.z", problem.str());
  }
  if (block.velocity().z() != 0) {
    throw core::InputError("", path + ".velocity.z", "must be 0: the scene is planar");
  }
}

void checkCount(const v1::Simulation& simulation, std::uint64_t limit) {
  std::uint64_t total = 0;
  for (int f = 0; f < simulation.fluids_size(); ++f) {
    for (int b = 0; b < simulation.fluids(f).blocks_size(); ++b) {
      total += particlesOf(simulation.fluids(f).blocks(b));
      if (total <= limit) continue;
      throw core::InputError("", blockPath(f, b),
                             "the scene has at least " + std::to_string(total) + " particles; this machine's free " +
                                 "memory allows " + std::to_string(limit));
    }
  }
  if (total == 0) throw core::InputError("", "simulation.fluids", "the scene has no particles; it needs at least one");
}

/// Adds the particles of a block that bodies leave room for.
void addParticles(const v1::Block& block, const std::string& path, double spacing, const Container& container,
                  const Bodies& bodies, InitialState& state) {
  const Triple first = toTriple(block.first_particle());
  const auto place = [&](std::size_t axis, std::uint32_t step) {
    return static_cast<float>(first[axis] - container.origin[axis] + spacing * step);
  };
  std::vector<Float4>& position = state.particles.position;
  const std::size_t before = position.size();
  std::size_t lastBody = 0;
  position.reserve(before + particlesOf(block));
  for (std::uint32_t k = 0; k < block.count_z(); ++k) {
    for (std::uint32_t j = 0; j < block.count_y(); ++j) {
      for (std::uint32_t i = 0; i < block.count_x(); ++i) {
        const Float4 x{place(0, i), place(1, j), place(2, k), 0};
        if (const auto body = bodies.bodyAt({x.x, x.y, x.z}, kStartingDistance * spacing)) {
          lastBody = *body;
          ++state.takenOut[lastBody];
          continue;
        }
        position.push_back(x);
      }
    }
  }
  if (position.size() > before) return;
  throw core::InputError("", path,
                         "the whole block lies inside " + bodies.nameOf(lastBody) +
                             " or another body, or nearer than half a spacing to its surface: nothing is left of it");
}

}  // namespace

const std::string& InitialState::blockOf(std::uint32_t id) const {
  const auto end = std::ranges::upper_bound(blockEnds, std::uint64_t{id});
  return blocks[static_cast<std::size_t>(end - blockEnds.begin())];
}

InitialState initialState(const v1::Simulation& simulation, const Container& container, const Bodies& bodies,
                          std::uint64_t particleLimit) {
  const double spacing = simulation.particle_spacing();
  checkCount(simulation, particleLimit);

  InitialState initial;
  initial.takenOut.resize(bodies.size());
  ParticleState& state = initial.particles;
  for (int f = 0; f < simulation.fluids_size(); ++f) {
    for (int b = 0; b < simulation.fluids(f).blocks_size(); ++b) {
      const v1::Block& block = simulation.fluids(f).blocks(b);
      const std::string path = blockPath(f, b);
      checkInside(block, path, container, spacing);
      if (container.plane) checkPlanar(block, path, container);
      addParticles(block, path, spacing, container, bodies, initial);
      initial.blocks.push_back(path);
      initial.blockEnds.push_back(state.size());
      const Float4 velocity{static_cast<float>(block.velocity().x()), static_cast<float>(block.velocity().y()),
                            static_cast<float>(block.velocity().z()), 0};
      state.velocity.resize(state.size(), velocity);
      if (simulation.fluids_size() > 1) state.fluid.resize(state.size(), static_cast<std::uint8_t>(f));
    }
  }
  state.densityImpulse.resize(state.size());
  state.id.resize(state.size());
  for (std::uint32_t i = 0; i < state.size(); ++i) state.id[i] = i;
  return initial;
}

}  // namespace sluice::sim
