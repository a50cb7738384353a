#include "neighbour_lists.h"

#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include "lattice.h"

namespace sluice::sim {
namespace {

constexpr double kSpacing = 0.05;
constexpr double kSupport = 0.1;
constexpr std::array<double, 3> kSize{0.8, 0.7, 0.9};

/// A jittered lattice that fills the box, two of whose particles coincide, sorted.
struct Cloud {
  CellGrid grid{CellGeometry::covering(kSize, kSupport, 1 << 16)};
  std::vector<Float4> positions;

  Cloud() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> jitter(-0.02F, 0.02F);
    std::vector<Float4> points;
    for (double x = kSpacing; x < kSize[0]; x += kSpacing) {
      for (double y = kSpacing; y < kSize[1]; y += kSpacing) {
        for (double z = kSpacing; z < kSize[2]; z += kSpacing) {
          points.push_back({static_cast<float>(x) + jitter(random), static_cast<float>(y) + jitter(random),
                            static_cast<float>(z) + jitter(random), 0});
        }
      }
    }
    points.push_back(points[points.size() / 2]);
    grid.sort(points, Team(1));
    for (const std::uint32_t from : grid.order()) positions.push_back(points[from]);
  }
};

const double kVolume = particleVolume(KernelKind::CubicSpline, kSpacing, kSupport);
const PairScale kScale({3, KernelKind::CubicSpline, kSpacing, kSupport, kVolume});

NeighbourLists listsOf(const Cloud& cloud, const PairLoops& loops, int threads = 1) {
  NeighbourLists lists(loops, kScale);
  lists.find(cloud.grid, cloud.positions, Team(threads));
  return lists;
}

/// The stored pairs of every particle: neighbour → gradient in quanta.
std::vector<std::map<std::uint32_t, std::array<int, 3>>> pairsOf(const NeighbourLists& lists, std::size_t particles) {
  std::vector<std::map<std::uint32_t, std::array<int, 3>>> pairs(particles);
  for (std::size_t c = 0; c < chunkCount(particles); ++c) {
    const PairList list = lists.chunk({c, c * kChunk, std::min((c + 1) * kChunk, particles)});
    const PairGroup* group = list.groups;
    for (std::uint32_t i = list.first; i < list.last; ++i) {
      std::size_t left = lists.neighbours()[i];
      for (int g = 0; g < list.groupCount[i]; ++g, ++group) {
        for (int p = 0; p < 4; ++p) {
          const auto& gradient = group->gradient[p];
          if (left > 0) {
            pairs[i][group->neighbour[p]] = {gradient[0], gradient[1], gradient[2]};
            --left;
          } else {
            EXPECT_EQ(group->neighbour[p], i) << "padding";
            EXPECT_TRUE(gradient[0] == 0 && gradient[1] == 0 && gradient[2] == 0) << "padding";
          }
        }
      }
    }
  }
  return pairs;
}

TEST(NeighbourLists, MatchNaiveSearch) {
  const Cloud cloud;
  const NeighbourLists lists = listsOf(cloud, bestPairLoops());
  const auto pairs = pairsOf(lists, cloud.positions.size());
  std::vector<std::uint16_t> fluidNeighbours(cloud.positions.size());
  for (std::size_t c = 0; c < chunkCount(cloud.positions.size()); ++c) {
    lists.countFluidNeighbours({c, c * kChunk, std::min((c + 1) * kChunk, cloud.positions.size())}, fluidNeighbours);
  }
  for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
    double density = 0;
    std::size_t neighbours = 0;
    for (std::uint32_t j = 0; j < cloud.positions.size(); ++j) {
      const double dx = cloud.positions[i].x - cloud.positions[j].x;
      const double dy = cloud.positions[i].y - cloud.positions[j].y;
      const double dz = cloud.positions[i].z - cloud.positions[j].z;
      const double r = std::sqrt(dx * dx + dy * dy + dz * dz);
      density += kVolume * kernelValue<CubicSpline>(r, kSupport);
      if (i == j || r >= kSupport) continue;
      ++neighbours;
      ASSERT_TRUE(pairs[i].contains(j)) << i << ", " << j;
      // Half a quantum is the rounding; the rest is the float arithmetic before it.
      const double slope = r > 0 ? kVolume * kernelSlope<CubicSpline>(r, kSupport) / r / kScale.quantum : 0;
      EXPECT_NEAR(pairs[i].at(j)[0], slope * dx, 0.6);
      EXPECT_NEAR(pairs[i].at(j)[1], slope * dy, 0.6);
      EXPECT_NEAR(pairs[i].at(j)[2], slope * dz, 0.6);
    }
    EXPECT_EQ(neighbours, lists.neighbours()[i]);
    EXPECT_EQ(neighbours, fluidNeighbours[i]);
    EXPECT_NEAR(lists.density()[i], density, 1e-5);
  }
}

TEST(NeighbourLists, GradientsOfAPairAreExactlyOpposite) {
  const Cloud cloud;
  const auto pairs = pairsOf(listsOf(cloud, bestPairLoops()), cloud.positions.size());
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    for (const auto& [j, g] : pairs[i]) {
      const auto& back = pairs[j].at(i);
      EXPECT_TRUE(back[0] == -g[0] && back[1] == -g[1] && back[2] == -g[2]) << i << ", " << j;
    }
  }
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Of two fluids, particles alternating by their number in threes; `several` is false for one fluid.
struct TwoFluids {
  std::vector<std::uint8_t> fluid;
  Mobility mobility;
  PairStrength friction;

  TwoFluids(std::size_t particles, bool several) {
    for (std::size_t i = 0; i < particles; ++i) fluid.push_back(i / 3 % 2);
    friction.strength[0] = {1e-4F, 3e-5F};
    friction.strength[1] = {2e-4F, 5e-4F};
    if (!several) return;
    mobility.ofFluid = {1, 2.5F};
    mobility.fluid = friction.fluid = fluid.data();
  }
};

void expectTheSameBitsOfAllInstructionSets(bool severalFluids) {
  const Cloud cloud;
  const std::size_t particles = cloud.positions.size();
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-1, 1);
  std::vector<Float4> velocity(particles);
  std::vector<Float4> impulse(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    velocity[i] = {value(random), value(random), value(random), 0};
    const float k = std::abs(value(random));
    impulse[i] = {k, k, k, k};
  }
  const std::vector<float> factor(particles, 1e-3F);
  const TwoFluids fluids(particles, severalFluids);
  const auto& [fluid, mobility, friction] = fluids;

  struct Results {
    NeighbourLists lists;
    std::vector<Float4> moved, impulse, viscous;
    std::vector<float> squares;
    double error = 0;
  };
  std::vector<Results> results;
  for (const PairLoops* loops : availablePairLoops()) {
    Results r{listsOf(cloud, *loops), std::vector<Float4>(particles), impulse, std::vector<Float4>(particles),
              std::vector<float>(particles)};
    Team(1).forEachChunk(particles, [&](const Chunk& chunk) {
      const PairList list = r.lists.chunk(chunk);
      if (severalFluids) loops->weighSquares(list, mobility, r.squares.data());
      loops->applyImpulses(list, mobility, impulse.data(), r.lists.gradientSum().data(), velocity.data(),
                           r.moved.data());
      r.error += loops
                     ->relaxImpulses(list, velocity.data(), r.lists.gradientSum().data(), factor.data(),
                                     r.lists.density().data(), 0.002F, 0.5F, r.impulse.data())
                     .sum;
      loops->applyViscosity(list, kScale, friction, cloud.positions.data(), velocity.data(), r.viscous.data());
    });
    results.push_back(std::move(r));
  }
  EXPECT_GT(results.front().error, 0);
  for (const Results& r : results) {
    SCOPED_TRACE(std::string(r.lists.loops().instructionSet));
    EXPECT_TRUE(sameBits(r.lists.density(), results.front().lists.density()));
    EXPECT_TRUE(sameBits(r.lists.gradientSum(), results.front().lists.gradientSum()));
    EXPECT_TRUE(sameBits(r.lists.gradientSquares(), results.front().lists.gradientSquares()));
    EXPECT_TRUE(sameBits(r.squares, results.front().squares));
    EXPECT_TRUE(sameBits(r.moved, results.front().moved));
    EXPECT_TRUE(sameBits(r.impulse, results.front().impulse));
    EXPECT_TRUE(sameBits(r.viscous, results.front().viscous));
    EXPECT_EQ(r.error, results.front().error);
  }
}

TEST(PairLoops, AllInstructionSetsGiveTheSameBits) { expectTheSameBitsOfAllInstructionSets(false); }

TEST(PairLoops, AllInstructionSetsGiveTheSameBitsForSeveralFluids) { expectTheSameBitsOfAllInstructionSets(true); }

// Each loop over two fluids against sums written out pair by pair.
TEST(PairLoops, FluidsWeighAsTheirTablesSay) {
  const Cloud cloud;
  const std::size_t particles = cloud.positions.size();
  const NeighbourLists lists = listsOf(cloud, bestPairLoops());
  const auto pairs = pairsOf(lists, particles);
  const TwoFluids fluids(particles, true);
  std::vector<Float4> velocity(particles), impulse(particles), moved(particles), viscous(particles);
  std::vector<float> squares(particles);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(0, 1);
  for (std::size_t i = 0; i < particles; ++i) {
    velocity[i] = {value(random), value(random), value(random), 0};
    impulse[i].x = impulse[i].y = impulse[i].z = impulse[i].w = value(random);
  }
  for (std::size_t c = 0; c < chunkCount(particles); ++c) {
    const PairList list = lists.chunk({c, c * kChunk, std::min((c + 1) * kChunk, particles)});
    lists.loops().weighSquares(list, fluids.mobility, squares.data());
    lists.loops().applyImpulses(list, fluids.mobility, impulse.data(), lists.gradientSum().data(), velocity.data(),
                                moved.data());
    lists.loops().applyViscosity(list, kScale, fluids.friction, cloud.positions.data(), velocity.data(),
                                 viscous.data());
  }
  const auto vector = [](const Float4& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  for (std::uint32_t i = 0; i < particles; ++i) {
    double square = 0;
    Eigen::Vector3d push = impulse[i].x * vector(lists.gradientSum()[i]);
    Eigen::Vector3d drag = Eigen::Vector3d::Zero();
    for (const auto& [j, quanta] : pairs[i]) {
      const Eigen::Vector3d gradient = kScale.quantum * Eigen::Vector3d(quanta[0], quanta[1], quanta[2]);
      square += fluids.mobility.ofFluid[fluids.fluid[j]] * gradient.squaredNorm();
      push += impulse[j].x * gradient;
      const Eigen::Vector3d xij = vector(cloud.positions[i]) - vector(cloud.positions[j]);
      drag += fluids.friction.strength[fluids.fluid[i]][fluids.fluid[j]] *
              (vector(velocity[i]) - vector(velocity[j])).dot(gradient) /
              (xij.squaredNorm() + 0.01 * kSupport * kSupport) * xij;
    }
    push *= fluids.mobility.ofFluid[fluids.fluid[i]];
    EXPECT_NEAR(squares[i], square, 1e-5 * square);
    EXPECT_LT((vector(moved[i]) - (vector(velocity[i]) - push)).norm(), 1e-5 * (1 + push.norm()));
    EXPECT_LT((vector(viscous[i]) - (vector(velocity[i]) + drag)).norm(), 1e-5 * (1 + drag.norm()));
  }
}

}  // namespace
}  // namespace sluice::sim
