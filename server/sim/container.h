#pragma once

#include <array>
#include <optional>

#include "sluice/solids/enclosure.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// How far inside the container's faces a particle has to start, in spacings: a lattice one spacing from a face is at
/// rest. The remainder is for decimal fractions that are no floats.
inline constexpr double kClearance = 0.99;

/// How far from a planar scene's plane a volume may be said to be, m: what decimal fractions are rounded by.
inline constexpr double kPlaneTolerance = 1e-9;

/// The container with the lower corner of the box around it as the origin of the particles' coordinates.
struct Container {
  std::array<double, 3> origin{};  ///< m, in the scene's coordinates.
  std::array<double, 3> size{};    ///< Of the box, m.
  /// Of a planar scene: where along z its particles are, m above the lower corner. Its walls are those in x and y.
  std::optional<double> plane;
  /// What leaves at one side comes back at the other; there are no walls. Of experiments alone.
  bool periodic = false;

  /// Its faces, about the same origin, where they are not those of the box alone.
  std::optional<solids::Enclosure> enclosure = std::nullopt;

  /// Directions that have walls: the first two or all three.
  std::size_t walledAxes() const { return plane ? 2 : 3; }

  /// Its size along periodic axes, 0 along others, m.
  std::array<double, 3> period() const {
    return {periodic ? size[0] : 0, periodic ? size[1] : 0, periodic && !plane ? size[2] : 0};
  }
};

/// Throws core::InputError where the container is narrower than two spacings, planes leave no room in it, or a planar
/// scene has another one than a box. The plane is that of the first block, ball or emitter.
Container containerOf(const v1::Simulation& simulation);

}  // namespace sluice::sim
