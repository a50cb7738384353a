#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "container.h"
#include "particles.h"
#include "sluice/solids/placed_body.h"
#include "team.h"

namespace sluice::sim {

/// The largest ball that is added at once, in spacings: a million particles.
inline constexpr double kLargestBall = 64;

/// A ball of particles on a cubic lattice (in a planar scene, a disc on a square one) around its centre.
struct AddedBall {
  Eigen::Vector3d centre;  ///< In the container's coordinates, m.
  double radius = 0;       ///< m; of kLargestBall spacings at most.
  double spacing = 0;      ///< m.
};

/// What a ball finds in its way.
struct Surroundings {
  const Container& container;
  std::span<const solids::PlacedBody* const> bodies;
  const std::vector<Float4>& particles;  ///< Positions, m.
};

/// The places of a ball that particles can take.
struct BallPlaces {
  std::vector<Float4> free;  ///< m.
  std::size_t byFluid = 0;   ///< How many are nearer to another particle than 0.9 spacings.
  std::size_t bySolids = 0;  ///< How many are in a wall or body, or as near to one as no particle may start.
};

BallPlaces placesOf(const AddedBall& ball, const Surroundings& around, const Team& team);

}  // namespace sluice::sim
