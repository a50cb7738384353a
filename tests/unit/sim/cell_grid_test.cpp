#include "cell_grid.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace sluice::sim {
namespace {

constexpr std::array<double, 3> kSize{1.0, 0.7, 1.3};
constexpr double kSupport = 0.1;

std::vector<Float4> randomPoints(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Float4> points(count);
  for (Float4& p : points) {
    p = {static_cast<float>(kSize[0]) * unit(random), static_cast<float>(kSize[1]) * unit(random),
         static_cast<float>(kSize[2]) * unit(random), 0};
  }
  return points;
}

CellGrid sortedGrid(const std::vector<Float4>& points, int threads, std::uint64_t cellLimit = 1 << 20) {
  CellGrid grid(CellGeometry::covering(kSize, kSupport, cellLimit));
  grid.sort(points, Team(threads));
  return grid;
}

TEST(CellGrid, OrdersByCellAndKeepsTheOrderWithinACell) {
  const std::vector<Float4> points = randomPoints(2000);
  const CellGrid grid = sortedGrid(points, 1);
  std::vector<std::uint32_t> expected(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) expected[i] = i;
  std::stable_sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
    return grid.geometry().cellOf(points[a]) < grid.geometry().cellOf(points[b]);
  });
  EXPECT_EQ(grid.order(), expected);
}

TEST(CellGrid, OrderDoesNotDependOnThreads) {
  const std::vector<Float4> points = randomPoints(5000);
  EXPECT_EQ(sortedGrid(points, 1).order(), sortedGrid(points, 4).order());
}

void expectEveryCloseNeighbourAround(std::uint64_t cellLimit) {
  const std::vector<Float4> points = randomPoints(1500);
  const CellGrid grid = sortedGrid(points, 2, cellLimit);
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::set<std::uint32_t> around;
    const CellGrid::Neighbourhood neighbourhood = grid.around(grid.cellOfSorted()[k]);
    for (int r = 0; r < neighbourhood.count; ++r) {
      for (std::uint32_t j = neighbourhood.ranges[r].first; j < neighbourhood.ranges[r].last; ++j) around.insert(j);
    }
    EXPECT_EQ(around.size(), neighbourhood.points);
    const Float4& a = points[grid.order()[k]];
    for (std::uint32_t j = 0; j < points.size(); ++j) {
      const Float4& b = points[grid.order()[j]];
      if (std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) < kSupport) {
        ASSERT_TRUE(around.contains(j));
      }
    }
  }
}

TEST(CellGrid, NeighbourhoodHoldsEveryPointWithinTheSupport) { expectEveryCloseNeighbourAround(1 << 20); }

TEST(CellGrid, StillDoesWhenCellsHadToBeMadeLarger) { expectEveryCloseNeighbourAround(100); }

TEST(CellGeometry, KeepsToItsLimit) {
  const CellGeometry huge = CellGeometry::covering({1e4, 1e4, 1e4}, 1e-3, 1 << 16);
  EXPECT_LE(huge.count(), std::size_t{1} << 16);
  EXPECT_GT(huge.count(), 1000U);
}

TEST(CellGeometry, PointsOutsideBelongToTheNearestCell) {
  const CellGeometry geometry = CellGeometry::covering(kSize, kSupport, 1 << 20);
  EXPECT_EQ(geometry.cellOf({-1, -1, -1, 0}), 0U);
  EXPECT_EQ(geometry.cellOf({9, 9, 9, 0}), geometry.count() - 1);
}

}  // namespace
}  // namespace sluice::sim
