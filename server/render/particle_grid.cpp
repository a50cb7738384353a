#include "particle_grid.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace sluice::render {

ParticleCells ParticleCells::covering(std::span<const Eigen::Vector3f> points, float leastEdge) {
  ParticleCells cells;
  cells.edge = leastEdge;
  if (points.empty()) return cells;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : points) box.extend(point);
  cells.corner = box.min();
  // In doubles, because a single particle that has flown far away would need more cells than an int can count.
  const Eigen::Vector3d size = box.sizes().cast<double>();
  const double limit = 4.0 * static_cast<double>(points.size()) + 65536.0;
  double edge = leastEdge;
  Eigen::Vector3d count;
  for (;; edge *= 1.25) {
    count = (size / edge).array().floor() + 1.0;
    if (count.prod() <= limit) break;
  }
  cells.edge = static_cast<float>(edge);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells.count[axis] = static_cast<int>(count(static_cast<Eigen::Index>(axis)));
  }
  return cells;
}

std::array<int, 3> ParticleCells::cellOf(const Eigen::Vector3f& point) const {
  // A cell is found with an error of a few roundings; what then lies a hair beyond the next cell is a pair at the very
  // end of its reach, which weighs nothing.
  const Eigen::Vector3f place = (point - corner) / edge;
  std::array<int, 3> cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float most = static_cast<float>(count[axis] - 1);
    cell[axis] = static_cast<int>(std::clamp(place(static_cast<Eigen::Index>(axis)), 0.0F, most));
  }
  return cell;
}

ParticleGrid::ParticleGrid(std::span<const Eigen::Vector3f> points, float reach)
    : cells_(ParticleCells::covering(points, reach)),
      starts_(cells_.total() + 1),
      order_(points.size()),
      points_(points.size()) {
  std::vector<std::uint32_t> cellOf(points.size());
  const auto size = static_cast<std::ptrdiff_t>(points.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    const auto [x, y, z] = cells_.cellOf(points[static_cast<std::size_t>(i)]);
    cellOf[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(cells_.index(x, y, z));
  }
  for (const std::uint32_t cell : cellOf) ++starts_[cell + 1];
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t place = next[cellOf[i]]++;
    order_[place] = i;
    points_[place] = points[i];
  }
}

}  // namespace sluice::render
