#include "light_map.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <numeric>

#include "column_and_sheet.h"

namespace sluice::render {
namespace {

const Eigen::Vector3f kSun = Eigen::Vector3f(0.45F, 0.75F, 0.35F).normalized();
constexpr float kSpacing = 0.02F;
constexpr float kIndex = 1.333F;

LitLiquid water() { return {Eigen::Array3f(2.6F, 0.75F, 0.45F), kIndex, false}; }

/// A lattice of particles between two corners, clipped by `keep`.
template <class Keep>
std::vector<Eigen::Vector3f> lattice(const Eigen::Vector3f& low, const Eigen::Vector3f& high, const Keep& keep) {
  std::vector<Eigen::Vector3f> positions;
  for (float y = low.y() + 0.5F * kSpacing; y < high.y(); y += kSpacing) {
    for (float z = low.z() + 0.5F * kSpacing; z < high.z(); z += kSpacing) {
      for (float x = low.x() + 0.5F * kSpacing; x < high.x(); x += kSpacing) {
        if (keep(Eigen::Vector3f(x, y, z))) positions.emplace_back(x, y, z);
      }
    }
  }
  return positions;
}

std::vector<Eigen::Vector3f> box(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  return lattice(low, high, [](const Eigen::Vector3f&) { return true; });
}

struct Texel {
  Eigen::Array3f factor;
  float front;
};

/// The cell that sunlight falls through on its way to `world`.
Texel at(const LightMap& map, const Eigen::Vector3f& world) {
  const Eigen::Vector3f place = map.grid.axes.toLight(world);
  const Eigen::Vector2f cell = (place.head<2>() - map.grid.corner) / map.grid.cell;
  const auto x = static_cast<std::size_t>(cell.x());
  const auto y = static_cast<std::size_t>(cell.y());
  const float* texel = map.texels.data() + 4 * (y * static_cast<std::size_t>(map.grid.width) + x);
  return {{texel[0], texel[1], texel[2]}, texel[3]};
}

LightMap make(std::span<const Eigen::Vector3f> positions, const LitLiquid& liquid, float caustics,
              const Eigen::Vector3f& sun = kSun, float floorHeight = 0.0F) {
  LightMapper mapper;
  return mapper.make({.positions = positions, .fluids = {}, .spacing = kSpacing, .floorHeight = floorHeight},
                     {&liquid, 1}, {.sun = sun, .caustics = caustics, .surfaceDeviation = 2.0F * kSpacing});
}

TEST(LightMap, SlabLetsThroughWhatBeerAndSnellSay) {
  const float depth = 0.2F;
  const std::vector<Eigen::Vector3f> slab = box({-0.8F, 0.0F, -0.8F}, {0.8F, depth, 0.8F});
  const float cosine = std::sqrt(1.0F - (1.0F - kSun.y() * kSun.y()) / (kIndex * kIndex));
  const Eigen::Array3f expected = (-water().absorption * depth / cosine).exp();
  for (const float caustics : {0.0F, 1.0F}) {
    const LightMap map = make(slab, water(), caustics);
    for (const Eigen::Vector3f& place : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.2F, 0, -0.13F)}) {
      const Texel texel = at(map, place);
      for (int channel = 0; channel < 3; ++channel) {
        // Cells meet whole numbers of particles, give or take: 1 %.
        EXPECT_NEAR(texel.factor[channel], expected[channel], 0.015F) << caustics;
      }
    }
  }
}

TEST(LightMap, FarFromTheLiquidLightIsAsItWas) {
  const LightMap map = make(box({-0.3F, 0.0F, -0.3F}, {0.3F, 0.1F, 0.3F}), water(), 1.0F);
  const float* const corner = map.texels.data();
  EXPECT_EQ(corner[0], 1.0F);
  EXPECT_GE(corner[3], kEmptyCell);
  for (std::size_t i = 0; i < map.texels.size(); i += 4) EXPECT_GE(map.texels[i], 0.0F);
}

TEST(LightMap, FrontTellsWhatStandsBeforeTheLiquid) {
  const LightMap map = make(box({-0.3F, 0.5F, -0.3F}, {0.3F, 0.7F, 0.3F}), water(), 0.0F);
  const Eigen::Vector3f inside(0.0F, 0.6F, 0.0F);
  const float front = at(map, inside).front;
  EXPECT_LT(front, map.grid.axes.toLight(inside).z());
  EXPECT_GT(front, map.grid.axes.toLight(inside + 0.3F * kSun).z());
}

TEST(LightMap, OpaqueLiquidShadesWithASoftRim) {
  LitLiquid milk = water();
  milk.opaque = true;
  const LightMap map = make(box({-0.3F, 0.0F, -0.3F}, {0.3F, 0.2F, 0.3F}), milk, 1.0F);
  EXPECT_LT(at(map, {0, 0, 0}).factor.maxCoeff(), 0.01F);
  const auto isSoft = [&](float x) {
    const float share = at(map, {x, 0, 0.2F}).factor[0];
    return share > 0.1F && share < 0.9F;
  };
  int soft = 0;
  for (int i = 0; i < 100; ++i) soft += isSoft(0.2F + 0.002F * static_cast<float>(i)) ? 1 : 0;
  EXPECT_GT(soft, 5);   // 1 cm
  EXPECT_LT(soft, 40);  // 8 cm
}

TEST(LightMap, EachLiquidAbsorbsItsOwnLight) {
  const std::vector<Eigen::Vector3f> left = box({-0.6F, 0.0F, -0.3F}, {0.0F, 0.1F, 0.3F});
  std::vector<Eigen::Vector3f> both = left;
  for (const Eigen::Vector3f& p : box({0.0F, 0.0F, -0.3F}, {0.6F, 0.1F, 0.3F})) both.push_back(p);
  std::vector<std::uint8_t> fluids(both.size(), 1);
  std::fill_n(fluids.begin(), left.size(), std::uint8_t{0});
  const std::array liquids{LitLiquid{Eigen::Array3f(20, 0, 0), 1.333F, false},
                           LitLiquid{Eigen::Array3f(0, 20, 0), 1.333F, false}};
  LightMapper mapper;
  const LightMap& map = mapper.make({both, fluids, kSpacing, 0.0F}, liquids, {.sun = kSun});
  const Eigen::Array3f red = at(map, {-0.35F, 0, 0}).factor;
  const Eigen::Array3f green = at(map, {0.25F, 0, 0}).factor;
  EXPECT_LT(red[0], 0.2F);
  EXPECT_NEAR(red[1], 1.0F, 1e-3F);
  EXPECT_LT(green[1], 0.2F);
  EXPECT_NEAR(green[0], 1.0F, 1e-3F);
}

TEST(LightMap, NeedsSunAndLiquidAboveTheFloor) {
  const std::vector<Eigen::Vector3f> below{{0.0F, -1.0F, 0.0F}};
  EXPECT_EQ(make(below, water(), 1.0F).grid.cells(), 0U);
  EXPECT_EQ(make({}, water(), 1.0F).grid.cells(), 0U);
  EXPECT_EQ(make(below, water(), 1.0F, {1.0F, 0.0F, 0.0F}, -2.0F).grid.cells(), 0U);
  EXPECT_GT(make(below, water(), 1.0F, kSun, -2.0F).grid.cells(), 0U);
}

TEST(LightMap, CellsStayWhereTheyAreInTheScene) {
  std::vector<Eigen::Vector3f> positions = box({-0.3F, 0.0F, -0.3F}, {0.3F, 0.2F, 0.3F});
  const LightMap before = make(positions, water(), 0.0F);
  positions.emplace_back(0.5F, 0.07F, 0.45F);  // the map grows
  const LightMap after = make(positions, water(), 0.0F);
  EXPECT_EQ(before.grid.cell, after.grid.cell);
  EXPECT_TRUE(before.grid.width != after.grid.width || before.grid.height != after.grid.height);
  // The sums come about in other parts.
  EXPECT_NEAR(at(before, {0, 0, 0}).factor[0], at(after, {0, 0, 0}).factor[0], 1e-5F);
}

TEST(LightMap, IsTheSameForAnyNumberOfThreads) {
  const core::ParticleSnapshot particles = testing::columnAndSheet(8000);
  const LitLiquid liquid = water();
  const auto draw = [&](int threads) {
    omp_set_num_threads(threads);
    LightMapper mapper;
    const auto d = static_cast<float>(particles.spacing);
    return mapper
        .make({particles.positions, {}, d, 0.0F}, {&liquid, 1},
              {.sun = kSun, .caustics = 1.0F, .surfaceDeviation = 2 * d})
        .texels;
  };
  const int usual = omp_get_max_threads();
  const std::vector<float> one = draw(1);
  for (const int threads : {2, 4, 5}) EXPECT_EQ(one, draw(threads)) << threads;
  omp_set_num_threads(usual);
}

}  // namespace
}  // namespace sluice::render
