#pragma once

#include <array>
#include <optional>

#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// How far inside the container's faces a particle has to start, in spacings: a lattice one spacing from a face is at
/// rest. The remainder is for decimal fractions that are no floats.
inline constexpr double kClearance = 0.99;

/// The container with its lower corner as the origin of the particles' coordinates.
struct Container {
  std::array<double, 3> origin{};  ///< m, in the scene's coordinates.
  std::array<double, 3> size{};    ///< m.
  /// Of a planar scene: where along z its particles are, m above the lower corner. Its walls are those in x and y.
  std::optional<double> plane;
  /// What leaves at one side comes back at the other; there are no walls. Of experiments alone.
  bool periodic = false;

  /// Directions that have walls: the first two or all three.
  std::size_t walledAxes() const { return plane ? 2 : 3; }

  /// Its size along periodic axes, 0 along others, m.
  std::array<double, 3> period() const {
    return {periodic ? size[0] : 0, periodic ? size[1] : 0, periodic && !plane ? size[2] : 0};
  }
};

/// Throws core::InputError where the box is empty or narrower than two spacings. The plane is that of the first block.
Container containerOf(const v1::Simulation& simulation);

}  // namespace sluice::sim
