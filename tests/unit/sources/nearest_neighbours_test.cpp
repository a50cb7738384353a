#include "nearest_neighbours.h"

#include <algorithm>
#include <limits>
#include <random>

#include "support.h"

namespace sluice::sources::test {
namespace {

double naiveMedian(const std::vector<Eigen::Vector3f>& points) {
  std::vector<double> distances;
  for (const Eigen::Vector3f& a : points) {
    double best = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3f& b : points) {
      if (a != b) best = std::min(best, (a.cast<double>() - b.cast<double>()).norm());
    }
    distances.push_back(best);
  }
  std::sort(distances.begin(), distances.end());
  return distances[distances.size() / 2];
}

TEST(NearestNeighbours, MatchNaive) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const float flatness : {1.0F, 1e-3F, 0.0F}) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 500; ++i) points.emplace_back(uniform(random), flatness * uniform(random), uniform(random));
    // A second cluster, dense and far away, and a stray point.
    for (int i = 0; i < 300; ++i) points.emplace_back(1e4F + 0.01F * uniform(random), 0.0F, uniform(random));
    points.emplace_back(-1e6F, 0.0F, 0.0F);
    EXPECT_NEAR(medianNearestNeighbourDistance(points), naiveMedian(points), 1e-9) << flatness;
  }
}

TEST(NearestNeighbours, OfALatticeAreItsSpacing) {
  EXPECT_NEAR(medianNearestNeighbourDistance(lattice(12, 0.025F).positions), 0.025, 1e-7);
}

TEST(NearestNeighbours, OfASampleComeClose) {
  EXPECT_NEAR(medianNearestNeighbourDistance(lattice(12, 0.025F).positions, 100), 0.025, 1e-7);
}

TEST(NearestNeighbours, CountCoincidentPointsOnce) {
  std::vector<Eigen::Vector3f> points = lattice(3, 1.0F).positions;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0.0F, 0.0F, 0.0F);
  EXPECT_EQ(medianNearestNeighbourDistance(points), 1);
}

TEST(NearestNeighbours, OfFewerThanTwoPointsAreNone) {
  EXPECT_EQ(medianNearestNeighbourDistance({}), 0);
  EXPECT_EQ(medianNearestNeighbourDistance({{1, 2, 3}}), 0);
  EXPECT_EQ(medianNearestNeighbourDistance(std::vector<Eigen::Vector3f>(9, {1, 2, 3})), 0);
}

}  // namespace
}  // namespace sluice::sources::test
