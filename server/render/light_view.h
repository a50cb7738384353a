#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sluice::render {

/// Axes of the scene as the sun sees it. Light space has x level, y across the light likewise, and z along the light,
/// m. The axes depend on the sun alone.
struct LightAxes {
  Eigen::Vector3f right;
  Eigen::Vector3f down;
  Eigen::Vector3f along;  ///< The way sunlight goes.

  Eigen::Vector3f toLight(const Eigen::Vector3f& world) const {
    return {world.dot(right), world.dot(down), world.dot(along)};
  }
  /// Where the plane y = `height` is along the light, over light space's y.
  float depthOfFloor(float y, float height) const { return (height - y * down.y()) / along.y(); }
};

/// `sun` is the unit vector towards the sun.
LightAxes lightAxes(const Eigen::Vector3f& sun);

/// Square cells over light space's x and y. Their borders lie at whole multiples of their size, wherever the grid
/// begins: what stands still in the scene meets the same cells whatever else moves.
struct LightGrid {
  LightAxes axes;
  float cell = 0;  ///< m.
  Eigen::Vector2f corner = Eigen::Vector2f::Zero();
  int width = 0;  ///< Cells.
  int height = 0;

  std::size_t cells() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Most cells along either side of a grid that liquid is drawn into.
inline constexpr int kMostLightCells = 256;

/// Sides are multiples of this, so that they do not change with every step of the particles.
inline constexpr int kLightCellsStep = 16;

/// Covers `bounds` (light space, m) and `margin` around it, with cells of `leastCell` or, where those would be too
/// many, that times a power of √2.
LightGrid coverWithCells(const LightAxes& axes, const Eigen::AlignedBox2f& bounds, float margin, float leastCell);

/// The same place in cells half as wide.
LightGrid refined(const LightGrid& grid);

}  // namespace sluice::render
