#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "container.h"
#include "particles.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// How far from a body's surface a particle has to come into the scene, in spacings: half of one, less what decimal
/// fractions lack.
inline constexpr double kStartingDistance = 0.495;

/// A part of space that is full of fluid at the start: those points of a cubic lattice that it holds.
struct FluidVolume {
  std::string noun;   ///< For messages: "block".
  std::string path;   ///< "simulation.fluids[0].blocks[1]".
  std::string place;  ///< Field path of where it is.
  int fluid = 0;
  v1::Vec3 velocity;

  std::array<double, 3> first{};          ///< The lattice's point with the smallest coordinates, in the container's, m.
  std::array<std::uint32_t, 3> counts{};  ///< Points along each axis.
  double expected = 0;                    ///< Particles, about, before any are made; 0 where that is not known.
  /// Whether a point lies within, in the container's coordinates; null: all of the lattice does.
  std::function<bool(const Eigen::Vector3d&)> contains;
};

/// What the scene's fluids start as: of each fluid blocks, then balls, then meshes. The lattice of a block begins at
/// its first particle; balls and meshes all share one, whose points are whole spacings from the container's lower
/// corner, so that what they fill side by side fits together, and keeps its distance from the container's faces.
///
/// Throws core::InputError with the field path where a fluid has neither a volume nor an emitter, where a mesh cannot
/// be read or is open, and, in a planar scene, where there are
/// meshes or a volume does not lie in its plane or move within it.
std::vector<FluidVolume> fluidVolumes(const v1::Simulation& simulation, const Container& container);

/// Calls `visit` with the places of a volume's particles, x fastest, in the container's coordinates.
void forEachPlace(const FluidVolume& volume, double spacing, const std::function<void(const Eigen::Vector3d&)>& visit);

/// Whether a point is no nearer to the container's faces than a lattice at rest.
bool isClear(const Eigen::Vector3d& x, const Container& container, double spacing);

/// Throws core::InputError where a particle of the volume, at `x`, is not clear of the container's faces.
void checkClear(const FluidVolume& volume, const Eigen::Vector3d& x, const Container& container, double spacing);

/// The same for all of a volume's particles; cheap where its lattice, or all of it, is clear.
void checkClear(const FluidVolume& volume, const Container& container, double spacing);

/// Whether a point lies in a volume and, along every axis, within half a spacing of its lattice.
bool holds(const FluidVolume& volume, const Eigen::Vector3d& x, double spacing);

}  // namespace sluice::sim
