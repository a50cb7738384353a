#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace sluice::render {

/// Liquid that sunlight passes before it meets the floor, over a square of the floor, for one set of particles.
struct ShadowMap {
  static constexpr int kEdge = 128;  ///< Cells along either side.

  Eigen::Vector2f corner;        ///< Least x and z, m.
  float edge = 0;                ///< Side of the square, m; 0 where nothing casts a shadow.
  std::vector<float> thickness;  ///< kEdge² lengths in m, x fastest; smooth, and 0 along the border.
};

/// Lets every particle's volume fall along the sunlight onto the floor. `sun` points to the sun, which must stand above
/// the horizon: the result is empty where it does not, or where no particle is above the floor.
ShadowMap castShadow(std::span<const Eigen::Vector3f> positions, float spacing, float floorHeight,
                     const Eigen::Vector3f& sun);

}  // namespace sluice::render
