#include "foam_grid.h"

#include <algorithm>
#include <cmath>

#include "foam_sums.h"

namespace sluice::sources {

namespace {

using Eigen::Vector3f;

/// More cells than this cost more to go through than wider ones to search: 8 MB of starts.
constexpr double kMostCells = 2e6;

/// Where padding stands, m: its square is still a float.
constexpr float kFarAway = 1e18F;

}  // namespace

void LiquidGrid::build(std::span<const Vector3f> positions, std::span<const Vector3f> velocities, float support,
                       int threads) {
  bounds_.setEmpty();
  for (const Vector3f& position : positions) bounds_.extend(position);
  if (bounds_.isEmpty()) bounds_.extend(Vector3f(Vector3f::Zero()));

  // A point's cell is found in floats; the wider edge keeps rounding from losing a neighbour.
  double edge = 1.0001 * static_cast<double>(support);
  const auto cellsAt = [&](double width) {
    std::array<double, 3> cells{};
    for (int axis = 0; axis < 3; ++axis) {
      cells[static_cast<std::size_t>(axis)] = std::floor(static_cast<double>(bounds_.sizes()[axis]) / width) + 1;
    }
    return cells;
  };
  std::array<double, 3> cells = cellsAt(edge);
  while (cells[0] * cells[1] * cells[2] > kMostCells) cells = cellsAt(edge *= 1.25);
  for (std::size_t axis = 0; axis < 3; ++axis) cells_[axis] = static_cast<std::uint32_t>(cells[axis]);
  inverseEdge_ = static_cast<float>(1 / edge);

  const auto count = static_cast<std::ptrdiff_t>(positions.size());
  cellOf_.resize(positions.size());
  order_.resize(positions.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    cellOf_[static_cast<std::size_t>(i)] = cellOf(positions[static_cast<std::size_t>(i)]);
  }
  // A counting sort keeps the order within a cell, whatever the number of threads.
  starts_.assign(std::size_t{cells_[0]} * cells_[1] * cells_[2] + 1, 0);
  for (const std::uint32_t cell : cellOf_) ++starts_[cell + 1];
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  for (std::uint32_t i = 0; i < cellOf_.size(); ++i) order_[starts_[cellOf_[i]]++] = i;
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_[0] = 0;

  for (std::vector<float>* array : {&x_, &y_, &z_, &vx_, &vy_, &vz_}) array->resize(positions.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t place = 0; place < count; ++place) {
    const auto k = static_cast<std::size_t>(place);
    const Vector3f& position = positions[order_[k]];
    const Vector3f velocity = velocities[order_[k]].allFinite() ? velocities[order_[k]] : Vector3f(Vector3f::Zero());
    x_[k] = position.x();
    y_[k] = position.y();
    z_[k] = position.z();
    vx_[k] = velocity.x();
    vy_[k] = velocity.y();
    vz_[k] = velocity.z();
  }
}

std::uint32_t LiquidGrid::cellOf(const Vector3f& point) const {
  const auto coordinate = [&](Eigen::Index axis) {
    const float scaled = (point[axis] - bounds_.min()[axis]) * inverseEdge_;
    if (!(scaled > 0)) return 0U;
    const std::uint32_t last = cells_[static_cast<std::size_t>(axis)] - 1;
    return scaled >= static_cast<float>(last) ? last : static_cast<std::uint32_t>(scaled);
  };
  return coordinate(0) + cells_[0] * (coordinate(1) + cells_[1] * coordinate(2));
}

LiquidGrid::Ranges LiquidGrid::around(std::uint32_t cell) const {
  const auto& [nx, ny, nz] = cells_;
  const std::uint32_t x = cell % nx;
  const std::uint32_t y = cell / nx % ny;
  const std::uint32_t z = cell / nx / ny;
  Ranges found;
  for (std::uint32_t k = z - std::min(z, 1U); k <= std::min(z + 1, nz - 1); ++k) {
    for (std::uint32_t j = y - std::min(y, 1U); j <= std::min(y + 1, ny - 1); ++j) {
      // The three cells of a row are one range.
      const std::size_t row = std::size_t{nx} * (j + std::size_t{ny} * k);
      const Range range{starts_[row + x - std::min(x, 1U)], starts_[row + std::min(x + 1, nx - 1) + 1]};
      if (range.first < range.last) found.ranges[found.count++] = range;
    }
  }
  return found;
}

void LiquidGrid::gather(std::uint32_t cell, NearbyLiquid& nearby) const {
  const Ranges around = this->around(cell);
  std::size_t count = 0;
  for (const Range& range : around.all()) count += range.last - range.first;
  const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  const auto fill = [&](const std::vector<float>& from, std::vector<float>& to, float padding) {
    to.resize(padded);
    auto next = to.begin();
    for (const Range& range : around.all()) next = std::copy(&from[range.first], &from[range.last - 1] + 1, next);
    std::fill(next, to.end(), padding);
  };
  fill(x_, nearby.x, kFarAway);
  fill(y_, nearby.y, kFarAway);
  fill(z_, nearby.z, kFarAway);
  fill(vx_, nearby.vx, 0);
  fill(vy_, nearby.vy, 0);
  fill(vz_, nearby.vz, 0);
  nearby.particle.clear();
  for (const Range& range : around.all()) {
    for (std::uint32_t k = range.first; k < range.last; ++k) nearby.particle.push_back(k);
  }
}

}  // namespace sluice::sources
