#include "light_view.h"

#include <cmath>
#include <numbers>

namespace sluice::render {

LightAxes lightAxes(const Eigen::Vector3f& sun) {
  LightAxes axes;
  axes.along = -sun;
  const Eigen::Vector3f level(sun.z(), 0.0F, -sun.x());
  // Straight overhead any level axis is across the light.
  axes.right = level.squaredNorm() > 1e-12F ? Eigen::Vector3f(level.normalized()) : Eigen::Vector3f::UnitX();
  axes.down = axes.along.cross(axes.right);
  return axes;
}

LightGrid coverWithCells(const LightAxes& axes, const Eigen::AlignedBox2f& bounds, float margin, float leastCell) {
  LightGrid grid;
  grid.axes = axes;
  grid.cell = leastCell;
  const float extent = bounds.sizes().maxCoeff() + 2.0F * margin;
  // One step of the sides is spent on where the corner happens to lie.
  while (extent > grid.cell * static_cast<float>(kMostLightCells - kLightCellsStep)) {
    grid.cell *= std::numbers::sqrt2_v<float>;
  }
  const float block = grid.cell * static_cast<float>(kLightCellsStep);
  const Eigen::Array2f first = ((bounds.min().array() - margin) / block).floor();
  const Eigen::Array2f last = ((bounds.max().array() + margin) / block).ceil();
  grid.corner = block * first;
  grid.width = kLightCellsStep * static_cast<int>(last.x() - first.x());
  grid.height = kLightCellsStep * static_cast<int>(last.y() - first.y());
  return grid;
}

LightGrid refined(const LightGrid& grid) {
  LightGrid fine = grid;
  fine.cell *= 0.5F;
  fine.width *= 2;
  fine.height *= 2;
  return fine;
}

}  // namespace sluice::render
