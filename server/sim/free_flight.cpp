#include "free_flight.h"

#include <algorithm>
#include <cmath>

namespace sluice::sim {

namespace {

// Cells looked through in each direction for the closest other particle.
constexpr int kReach = 3;

// Share of the support by which rounded positions may be wrong.
constexpr double kMargin = 1e-3;

struct Least {
  double square = std::numeric_limits<double>::infinity();
  Least& operator+=(const Least& other) {
    square = std::min(square, other.square);
    return *this;
  }
};

struct Largest {
  double square = 0;
  Largest& operator+=(const Largest& other) {
    square = std::max(square, other.square);
    return *this;
  }
};

double squaredDistance(const Float4& a, const Float4& b) {
  const double x = static_cast<double>(a.x) - b.x;
  const double y = static_cast<double>(a.y) - b.y;
  const double z = static_cast<double>(a.z) - b.z;
  return x * x + y * y + z * z;
}

/// Squared distance to the closest particle within kReach cells.
double closestSquare(const CellGrid& grid, const std::vector<Float4>& positions, std::size_t i) {
  const auto& cells = grid.geometry().cells;
  std::array<std::uint32_t, 3> low{};
  std::array<std::uint32_t, 3> high{};
  const std::array<float, 3> place{positions[i].x, positions[i].y, positions[i].z};
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t at = grid.geometry().coordinate(place[axis], axis);
    low[axis] = at < kReach ? 0 : at - kReach;
    high[axis] = std::min(at + kReach, cells[axis] - 1);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t z = low[2]; z <= high[2]; ++z) {
    for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
      const std::size_t row = std::size_t{cells[0]} * (y + std::size_t{cells[1]} * z);
      for (std::uint32_t j = grid.starts()[row + low[0]]; j < grid.starts()[row + high[0] + 1]; ++j) {
        if (j != i) least = std::min(least, squaredDistance(positions[i], positions[j]));
      }
    }
  }
  return least;
}

/// Bound on the speed at which any two particles approach each other: twice the largest difference from the first.
double closingSpeed(const std::vector<Float4>& velocities, const Team& team) {
  const auto largest = team.sumOverChunks<Largest>(velocities.size(), [&](const Chunk& chunk) {
    Largest part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      part.square = std::max(part.square, squaredDistance(velocities[i], velocities.front()));
    }
    return part;
  });
  return 2 * std::sqrt(largest.square);
}

}  // namespace

void FreeFlight::noteNone(const CellGrid& grid, const std::vector<Float4>& positions, double support,
                          const Team& team) {
  if (noneBefore_) {
    const auto least = team.sumOverChunks<Least>(positions.size(), [&](const Chunk& chunk) {
      Least part;
      for (std::size_t i = chunk.first; i < chunk.last; ++i) {
        part.square = std::min(part.square, closestSquare(grid, positions, i));
      }
      return part;
    });
    // What was not found among the cells lies beyond them.
    const double beyond = kReach / static_cast<double>(grid.geometry().inverseEdge);
    gap_ = std::min(std::sqrt(least.square), beyond) - (1 + kMargin) * support;
  }
  noneBefore_ = true;
}

void FreeFlight::save(core::StateWriter& out) const {
  out.write(noneBefore_);
  out.write(gap_);
}

void FreeFlight::resume(core::StateReader& in) {
  // Not read as a bool: a byte other than 0 and 1 makes none.
  std::uint8_t noneBefore = 0;
  in.read(noneBefore);
  noneBefore_ = noneBefore != 0;
  in.read(gap_);
}

bool FreeFlight::covers(const std::vector<Float4>& velocities, double seconds, const Team& team) const {
  return gap_ > 0 && closingSpeed(velocities, team) * seconds < gap_;
}

void FreeFlight::advance(const std::vector<Float4>& velocities, double seconds, const Team& team) {
  gap_ -= closingSpeed(velocities, team) * seconds;
}

}  // namespace sluice::sim
