#include "foam_potentials.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "foam_support.h"

namespace sluice::sources::test {
namespace {

using Eigen::Vector3f;

constexpr FoamRates kTrappedAirAlone{1, 0};
constexpr FoamRates kCrestsAlone{0, 1};

FoamPotentials potentialsOf(const Cube& cube, const FoamRates& rates, const FoamWalls& walls = {}, int threads = 1) {
  FoamPotentials potentials;
  potentials.compute(cube.grid(threads), walls, foamScales(cube.positions.size(), cube.spacing, 9.81), rates, threads);
  return potentials;
}

/// What is made in a second, in volumes of liquid particles: secondary particles have a size in proportion to theirs.
double volumeRate(const Cube& cube, const FoamRates& rates, const FoamWalls& walls = {}) {
  const FoamPotentials potentials = potentialsOf(cube, rates, walls);
  const double sum = std::accumulate(potentials.rates().begin(), potentials.rates().end(), 0.0);
  return sum * std::pow(static_cast<double>(cube.spacing), 3);
}

Vector3f diagonally(const Vector3f&) { return {2, 2, 0}; }

TEST(FoamPotentials, AreZeroInALiquidAtRest) { EXPECT_EQ(volumeRate(Cube(12, atRest), {1, 1}), 0); }

TEST(FoamPotentials, TrapNoAirInALiquidThatMovesAsOne) {
  EXPECT_EQ(volumeRate(Cube(12, diagonally), kTrappedAirAlone), 0);
}

TEST(FoamPotentials, TrapAirWhereLiquidCollidesAndNowhereElse) {
  const Cube cube(16, colliding);
  const LiquidGrid grid = cube.grid();
  const FoamPotentials potentials = potentialsOf(cube, kTrappedAirAlone);
  double made = 0;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const float away = std::abs(grid.position(k).x() - 0.5F);
    if (away > 2 * cube.spacing) {
      EXPECT_EQ(potentials.rates()[k], 0) << grid.position(k).transpose();
    }
    made += potentials.rates()[k];
  }
  EXPECT_GT(made, 0);
}

TEST(FoamPotentials, TrapNoAirWhereLiquidParts) {
  const auto parting = [](const Vector3f& x) -> Vector3f { return -colliding(x); };
  EXPECT_LT(volumeRate(Cube(16, parting), kTrappedAirAlone), 0.1 * volumeRate(Cube(16, colliding), kTrappedAirAlone));
}

TEST(FoamPotentials, TrapAsMuchAirAtTwiceTheResolution) {
  // Within a support radius of the cube's faces neighbours are missing: of the plane of collision that is 4·h, or 1/2
  // and 1/4, less than half of whose potential is lost.
  const double coarse = volumeRate(Cube(16, colliding), kTrappedAirAlone);
  const double fine = volumeRate(Cube(32, colliding), kTrappedAirAlone);
  EXPECT_NEAR(fine / coarse, 1, 0.25);
}

TEST(FoamPotentials, MakeAsMuchOfACrestAtTwiceTheResolution) {
  // The edge's two ends, where three faces meet, are a part of it that goes with h.
  const double coarse = volumeRate(Cube(16, diagonally), kCrestsAlone);
  const double fine = volumeRate(Cube(32, diagonally), kCrestsAlone);
  ASSERT_GT(coarse, 0);
  EXPECT_NEAR(fine / coarse, 1, 0.3);
}

TEST(FoamPotentials, SeeCrestsOnlyAtTheEdgeAhead) {
  const Cube cube(16, diagonally);
  const LiquidGrid grid = cube.grid();
  const FoamPotentials potentials = potentialsOf(cube, kCrestsAlone);
  const float reach = 2 * cube.spacing;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const Vector3f x = grid.position(k);
    const bool isAhead = x.x() > 1 - reach && x.y() > 1 - reach;
    // Where two other edges meet, at z = 0 and 1, some normals point ahead as well.
    const bool isAtAnEnd = x.z() < reach || x.z() > 1 - reach;
    if (!isAhead && !isAtAnEnd) {
      EXPECT_EQ(potentials.rates()[k], 0) << x.transpose();
    }
  }
}

TEST(FoamPotentials, TakeWallsForLiquid) {
  const FoamWalls walls(Eigen::AlignedBox3f(Vector3f(-1, -1, -1), Vector3f(1, 1, 2)));
  EXPECT_GT(volumeRate(Cube(16, diagonally), kCrestsAlone), 0);
  EXPECT_EQ(volumeRate(Cube(16, diagonally), kCrestsAlone, walls), 0);
}

TEST(FoamPotentials, AreProportionalToTheirFactors) {
  const Cube cube(12, colliding);
  EXPECT_NEAR(volumeRate(cube, {3, 0}) / volumeRate(cube, {1, 0}), 3, 1e-5);
  EXPECT_EQ(volumeRate(cube, {0, 0}), 0);
}

TEST(FoamPotentials, AreTheSameForAnyNumberOfThreads) {
  const Cube cube(16, colliding);
  const FoamPotentials one = potentialsOf(cube, {1, 1});
  for (const int threads : {2, 4}) EXPECT_EQ(potentialsOf(cube, {1, 1}, {}, threads).rates(), one.rates());
}

TEST(FoamPotentials, AreFiniteForCoincidentAndLoneParticles) {
  Cube cube(8, colliding);
  // A dozen in one place with different velocities, one by itself far away, and one without a velocity.
  for (int i = 0; i < 12; ++i) {
    cube.positions.emplace_back(0.5F, 0.5F, 0.5F);
    cube.velocities.emplace_back(static_cast<float>(i), -3.0F, 0.0F);
  }
  cube.positions.emplace_back(50, 50, 50);
  cube.velocities.emplace_back(5, 0, 0);
  cube.velocities[3].x() = std::numeric_limits<float>::quiet_NaN();
  const FoamPotentials potentials = potentialsOf(cube, {1, 1});
  for (const float rate : potentials.rates()) EXPECT_TRUE(std::isfinite(rate) && rate >= 0);
}

TEST(FoamWalls, OpenAnEighthInACornerAndAllInTheMiddle) {
  const FoamWalls walls(Eigen::AlignedBox3f(Vector3f::Zero(), Vector3f::Constant(10)));
  EXPECT_EQ(walls.openShare(Vector3f::Constant(5), 1, 0), 1);
  EXPECT_NEAR(walls.openShare(Vector3f(5, 0, 5), 1, 0), 0.5, 1e-6);
  EXPECT_NEAR(walls.openShare(Vector3f::Zero(), 1, 0), 0.125, 1e-6);
}

}  // namespace
}  // namespace sluice::sources::test
