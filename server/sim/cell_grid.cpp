#include "cell_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sluice::sim {

CellGeometry CellGeometry::covering(const std::array<double, 3>& size, double support, std::uint64_t cellLimit,
                                    const std::array<bool, 3>& periodic) {
  CellGeometry geometry;
  geometry.periodic = periodic;
  for (double edge = support;; edge *= 1.25) {
    double total = 1;
    double longest = 1;
    for (const double length : size) {
      const double cells = std::max(1.0, std::ceil(length / edge));
      longest = std::max(longest, cells);
      total *= cells;
    }
    if (total > static_cast<double>(cellLimit) && longest > 1) continue;
    // x / edge in floats is off by up to `longest` roundings of 6e-8; the wider cell keeps a point within reach of
    // every point that is closer than the support.
    const double widened = edge * (1 + 1e-5 + 5e-7 * longest);
    for (int axis = 0; axis < 3; ++axis) {
      const double cells = size[axis] / widened;
      geometry.cells[axis] =
          static_cast<std::uint32_t>(std::max(1.0, periodic[axis] ? std::floor(cells) : std::ceil(cells)));
    }
    geometry.inverseEdge = static_cast<float>(1 / widened);
    return geometry;
  }
}

void CellGrid::sort(const std::vector<Float4>& points, const Team& team) {
  cell_.resize(points.size());
  cellOfSorted_.resize(points.size());
  order_.resize(points.size());
  team.forEachChunk(points.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) cell_[i] = geometry_.cellOf(points[i]);
  });

  // Serial from here: about a hundredth of a step, and the moved data (in Simulation) is gathered in parallel.
  countStarts();
  for (std::uint32_t i = 0; i < cell_.size(); ++i) {
    const std::uint32_t place = starts_[cell_[i]]++;
    order_[place] = i;
    cellOfSorted_[place] = cell_[i];
  }
  // Each start has moved to the next cell's; move them back.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_[0] = 0;
}

void CellGrid::countStarts() {
  std::fill(starts_.begin(), starts_.end(), 0U);
  for (const std::uint32_t cell : cell_) ++starts_[cell + 1];
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
}

bool CellGrid::restore(const std::vector<std::uint32_t>& cells) {
  if (!std::ranges::is_sorted(cells) || (!cells.empty() && cells.back() >= geometry_.count())) return false;
  cell_ = cellOfSorted_ = cells;
  order_.resize(cells.size());
  std::iota(order_.begin(), order_.end(), 0U);
  countStarts();
  return true;
}

CellGrid::Neighbourhood CellGrid::around(std::uint32_t cell) const {
  const auto& [nx, ny, nz] = geometry_.cells;
  const std::uint32_t x = cell % nx;
  const std::uint32_t y = cell / nx % ny;
  const std::uint32_t z = cell / nx / ny;
  if (geometry_.periodic != std::array<bool, 3>{}) return aroundPeriodic({x, y, z});
  const std::uint32_t x0 = x == 0 ? 0 : x - 1;
  const std::uint32_t x1 = std::min(x + 1, nx - 1);

  Neighbourhood found;
  for (std::uint32_t k = z == 0 ? 0 : z - 1; k <= std::min(z + 1, nz - 1); ++k) {
    for (std::uint32_t j = y == 0 ? 0 : y - 1; j <= std::min(y + 1, ny - 1); ++j) {
      const std::size_t row = std::size_t{nx} * (j + std::size_t{ny} * k);
      const Range range{starts_[row + x0], starts_[row + x1 + 1], {}};
      if (range.first == range.last) continue;
      found.ranges[static_cast<std::size_t>(found.count++)] = range;
      found.points += range.last - range.first;
    }
  }
  return found;
}

CellGrid::Neighbourhood CellGrid::aroundPeriodic(const std::array<std::uint32_t, 3>& place) const {
  const auto& cells = geometry_.cells;
  Neighbourhood found;
  std::array<int, 3> offset{};
  for (offset[2] = -1; offset[2] <= 1; ++offset[2]) {
    for (offset[1] = -1; offset[1] <= 1; ++offset[1]) {
      for (offset[0] = -1; offset[0] <= 1; ++offset[0]) {
        std::array<std::size_t, 3> at{};
        Range range{};
        bool inside = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::int64_t count = cells[axis];
          const std::int64_t beside = std::int64_t{place[axis]} + offset[axis];
          range.image[axis] = static_cast<std::int8_t>(beside < 0 ? -1 : beside >= count ? 1 : 0);
          inside = inside && (geometry_.periodic[axis] || range.image[axis] == 0);
          at[axis] = static_cast<std::size_t>(beside - range.image[axis] * count);
        }
        if (!inside) continue;
        const std::size_t other = at[0] + cells[0] * (at[1] + std::size_t{cells[1]} * at[2]);
        range.first = starts_[other];
        range.last = starts_[other + 1];
        if (range.first == range.last) continue;
        found.ranges[static_cast<std::size_t>(found.count++)] = range;
        found.points += range.last - range.first;
      }
    }
  }
  return found;
}

}  // namespace sluice::sim
