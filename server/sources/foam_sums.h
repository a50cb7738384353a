#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "foam_grid.h"

namespace sluice::sources {

/// Sums run over this many particles at a time, on every machine, and are then added in one order.
inline constexpr std::size_t kLanes = 8;

// All sums are over the liquid's particles j closer than the support radius h to a point, with the weight
// W = 1 - r/h of [Ihmsen et al. 2012]; x_ij = x_i - x_j. What coincides with the point has no direction and counts as
// if it were at right angles to everything.

/// What a secondary particle meets.
struct SurroundingSums {
  float count = 0;
  float weight = 0;                                    ///< ΣW.
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();  ///< ΣW v_j, m/s.
};
SurroundingSums sumSurroundings(const NearbyLiquid& nearby, const Eigen::Vector3f& point, float support);

/// What a particle of the liquid meets, itself among it.
struct MotionSums {
  float count = 0;
  float approach = 0;                                 ///< Σ|v_ij|(1 - v̂_ij·x̂_ij)W, m/s.
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();  ///< ΣW x_ij, m: away from the liquid where there is a surface.
};
MotionSums sumMotion(const NearbyLiquid& nearby, const Eigen::Vector3f& point, const Eigen::Vector3f& velocity,
                     float support);

/// Unit normals beside the particles of NearbyLiquid; 0 off the surface.
struct NearbyNormals {
  std::vector<float> x, y, z;
};

/// How the surface bends around a particle of it.
struct BendSums {
  float weight = 0;  ///< ΣW over the surface's particles.
  float bend = 0;    ///< Σ(1 - n_i·n_j)W over those behind the tangent plane: where the surface is convex.
};
BendSums sumBend(const NearbyLiquid& nearby, const NearbyNormals& normals, const Eigen::Vector3f& point,
                 const Eigen::Vector3f& normal, float support);

}  // namespace sluice::sources
