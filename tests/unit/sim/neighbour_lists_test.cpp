#include "neighbour_lists.h"

#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

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
  std::vector<Float4> places = cloud.positions;
  for (std::size_t i = 0; i < particles; ++i) places[i].w = 1 + impulse[i].x;
  const TwoFluids fluids(particles, severalFluids);
  const auto& [fluid, mobility, friction] = fluids;

  struct Results {
    explicit Results(NeighbourLists found) : lists(std::move(found)) {}

    NeighbourLists lists;
    std::vector<Float4> moved, impulse, viscous, gradient, blocks, coherent, turned, spin;
    std::vector<float> squares, rate, diffusion;
    double error = 0;
  };
  std::vector<Results> results;
  for (const PairLoops* loops : availablePairLoops()) {
    Results r(listsOf(cloud, *loops));
    r.impulse = impulse;
    for (auto* values : {&r.moved, &r.viscous, &r.gradient, &r.coherent, &r.turned, &r.spin}) values->resize(particles);
    r.blocks.resize(3 * particles);
    for (auto* values : {&r.squares, &r.rate, &r.diffusion}) values->resize(particles);
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
      loops->densityRate(list, velocity.data(), r.lists.gradientSum().data(), r.rate.data());
      loops->weightedGradient(list, impulse.data(), r.gradient.data());
      loops->diffuse(list, kScale, friction, places.data(), r.diffusion.data());
      loops->viscosityBlocks(list, kScale, friction, cloud.positions.data(), r.blocks.data());
      loops->cohere(list, kScale, {friction, 0.1F}, places.data(), velocity.data(), velocity.data(), r.coherent.data());
      loops->exchangeSpin(list, kScale, {1e-4F, 0.1F, 0.2F}, cloud.positions.data(), velocity.data(), velocity.data(),
                          r.turned.data(), r.spin.data());
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
    EXPECT_TRUE(sameBits(r.rate, results.front().rate));
    EXPECT_TRUE(sameBits(r.gradient, results.front().gradient));
    EXPECT_TRUE(sameBits(r.diffusion, results.front().diffusion));
    EXPECT_TRUE(sameBits(r.blocks, results.front().blocks));
    EXPECT_TRUE(sameBits(r.coherent, results.front().coherent));
    EXPECT_TRUE(sameBits(r.turned, results.front().turned));
    EXPECT_TRUE(sameBits(r.spin, results.front().spin));
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

// The loops of the other solvers and forces against sums written out pair by pair.
TEST(PairLoops, OfForcesMatchSumsOverPairs) {
  const Cloud cloud;
  const std::size_t particles = cloud.positions.size();
  const NeighbourLists lists = listsOf(cloud, bestPairLoops());
  const auto pairs = pairsOf(lists, particles);
  const TwoFluids fluids(particles, true);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> value(-1, 1);
  std::vector<Float4> velocity(particles), normal(particles), spin(particles), places = cloud.positions;
  for (std::size_t i = 0; i < particles; ++i) {
    velocity[i] = {value(random), value(random), value(random), 0};
    normal[i] = {value(random), value(random), value(random), 0};
    spin[i] = {value(random), value(random), value(random), 0};
    places[i].w = 1.5F + value(random);
  }
  constexpr float kCurvature = 0.2F;
  constexpr SpinExchange kExchange{1e-4F, 0.1F, 0.2F};
  std::vector<Float4> blocks(3 * particles), coherent(particles), turned(particles), spun(particles);
  std::vector<float> rate(particles), diffusion(particles);
  for (std::size_t c = 0; c < chunkCount(particles); ++c) {
    const PairList list = lists.chunk({c, c * kChunk, std::min((c + 1) * kChunk, particles)});
    lists.loops().densityRate(list, velocity.data(), lists.gradientSum().data(), rate.data());
    lists.loops().diffuse(list, kScale, fluids.friction, places.data(), diffusion.data());
    lists.loops().viscosityBlocks(list, kScale, fluids.friction, cloud.positions.data(), blocks.data());
    lists.loops().cohere(list, kScale, {fluids.friction, kCurvature}, places.data(), normal.data(), velocity.data(),
                         coherent.data());
    lists.loops().exchangeSpin(list, kScale, kExchange, cloud.positions.data(), velocity.data(), spin.data(),
                               turned.data(), spun.data());
  }
  const auto vector = [](const Float4& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  for (std::uint32_t i = 0; i < particles; ++i) {
    double densityRate = 0;
    double spread = 0;
    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    Eigen::Vector3d push = Eigen::Vector3d::Zero();
    Eigen::Vector3d curl = Eigen::Vector3d::Zero();
    Eigen::Vector3d unlike = Eigen::Vector3d::Zero();
    for (const auto& [j, quanta] : pairs[i]) {
      const Eigen::Vector3d gradient = kScale.quantum * Eigen::Vector3d(quanta[0], quanta[1], quanta[2]);
      const Eigen::Vector3d xij = vector(cloud.positions[i]) - vector(cloud.positions[j]);
      const Eigen::Vector3d vij = vector(velocity[i]) - vector(velocity[j]);
      const double strength = fluids.friction.strength[fluids.fluid[i]][fluids.fluid[j]];
      const double softened = xij.squaredNorm() + 0.01 * kSupport * kSupport;
      const double distance = xij.norm();
      const double q = distance / kSupport;
      densityRate += vij.dot(gradient);
      spread += strength * (places[i].w - places[j].w) * xij.dot(gradient) / softened;
      block += strength * xij * gradient.transpose() / softened;
      const double cubed = std::pow((1 - q) * q, 3);
      const double attraction = q > 0.5 ? cubed : 2 * cubed - 1.0 / 64;
      if (distance > 0) pull += strength * 2 / (places[i].w + places[j].w) * attraction * xij / distance;
      pull += strength * 2 / (places[i].w + places[j].w) * kCurvature * (vector(normal[i]) - vector(normal[j]));
      push += (vector(spin[i]) + vector(spin[j])).cross(gradient);
      curl += vij.cross(gradient);
      unlike += kVolume * kernelValue<CubicSpline>(distance, kSupport) * (vector(spin[i]) - vector(spin[j]));
    }
    EXPECT_NEAR(rate[i], densityRate, 1e-4 * (1 + std::abs(densityRate)));
    EXPECT_NEAR(diffusion[i], spread, 1e-5 * (1 + std::abs(spread)));
    for (int column = 0; column < 3; ++column) {
      EXPECT_LT((vector(blocks[3 * i + column]) - block.col(column)).norm(), 1e-5 * (1 + block.norm()));
    }
    EXPECT_LT((vector(coherent[i]) - (vector(velocity[i]) - pull)).norm(), 1e-5);
    EXPECT_LT((vector(turned[i]) - (vector(velocity[i]) - 1e-4 * push)).norm(), 1e-5);
    const Eigen::Vector3d expectedSpin = (vector(spin[i]) + 0.1 * curl - 0.2 * unlike) / 1.2;
    EXPECT_LT((vector(spun[i]) - expectedSpin).norm(), 1e-4 * (1 + expectedSpin.norm()));
  }
}

}  // namespace
}  // namespace sluice::sim
