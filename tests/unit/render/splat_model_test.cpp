#include "splat_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "interior_particles.h"
#include "lattice_cloud.h"
#include "particle_grid.h"
#include "sluice/scene/scene.h"

namespace sluice::render {
namespace {

v1::Splats defaults() {
  v1::Splats splats;
  scene::complete(splats);
  return splats;
}

std::size_t count(const SplatModel& model, SplatRole role) {
  return static_cast<std::size_t>(std::ranges::count(model.roles, role));
}

TEST(ParticleGrid, FindsEveryNeighbour) {
  core::ParticleSnapshot cloud = latticeCloud(7, 6, 5, 0.5F);
  // One far away must neither be missed nor make the grid huge.
  cloud.positions.emplace_back(4e5F, -3e4F, 1e5F);
  const float reach = 0.12F;
  const ParticleGrid grid(cloud.positions, reach);
  for (const Eigen::Vector3f& p : cloud.positions) {
    std::vector<std::uint32_t> found;
    grid.forEachAround(p, [&](std::uint32_t place) {
      EXPECT_EQ(grid.points()[place], cloud.positions[grid.order()[place]]);
      if ((grid.points()[place] - p).norm() < reach) found.push_back(grid.order()[place]);
    });
    std::ranges::sort(found);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t j = 0; j < cloud.size(); ++j) {
      if ((cloud.positions[j] - p).norm() < reach) expected.push_back(j);
    }
    ASSERT_EQ(found, expected);
  }
  EXPECT_LT(ParticleCells::covering(cloud.positions, reach).total(), 100000U);
}

TEST(SplatModel, IsPlainWithoutDensitiesAndCounts) {
  core::ParticleSnapshot cloud = latticeCloud(9, 9, 9);
  cloud.densities.clear();
  cloud.neighbours.clear();
  v1::Splats splats = defaults();
  splats.set_radius_by_density(true);
  const SplatModel model = makeSplatModel(cloud, splats);
  EXPECT_TRUE(model.roles.empty());
  EXPECT_TRUE(model.radii.empty());
}

TEST(SplatModel, LessThanTheStrayDensityIsSpray) {
  core::ParticleSnapshot cloud = latticeCloud(4, 4, 4);
  v1::Splats splats = defaults();
  EXPECT_TRUE(makeSplatModel(cloud, splats).roles.empty()) << "nothing is stray, nothing interior";
  cloud.densities[7] = static_cast<float>(0.99 * splats.stray_density() * cloud.restDensity);
  cloud.densities[8] = static_cast<float>(1.01 * splats.stray_density() * cloud.restDensity);
  const SplatModel model = makeSplatModel(cloud, splats);
  EXPECT_EQ(model.role(7), SplatRole::Spray);
  EXPECT_EQ(count(model, SplatRole::Spray), 1U);
  splats.set_stray_density(0);
  EXPECT_TRUE(makeSplatModel(cloud, splats).roles.empty());
}

TEST(SplatModel, AParticleAloneAtAWallIsSpray) {
  // The wall makes its density that of a surface.
  core::ParticleSnapshot cloud = latticeCloud(4, 4, 4);
  cloud.neighbours[3] = 1;
  EXPECT_EQ(makeSplatModel(cloud, defaults()).role(3), SplatRole::Spray);
}

TEST(Interior, StartsBelowThreeLayers) {
  const int edge = 11;
  core::ParticleSnapshot cloud = latticeCloud(edge, edge, edge);
  // A hair, so that no particle stands at the border of two cells.
  cloud.spacing *= 1.001;
  const SplatModel model = makeSplatModel(cloud, defaults());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f place = (cloud.positions[i] / 0.05F).array().round();
    const float depth = std::min(place.minCoeff(), static_cast<float>(edge - 1) - place.maxCoeff());
    // Cells make the fourth layer one or the other.
    if (depth == 3) continue;
    EXPECT_EQ(model.role(i), depth < 3 ? SplatRole::Surface : SplatRole::Interior) << place.transpose();
  }
}

TEST(Interior, KeepsItsDistanceFromThinPlaces) {
  core::ParticleSnapshot cloud = latticeCloud(15, 15, 15, 0.2F);
  const std::size_t before = count(makeSplatModel(cloud, defaults()), SplatRole::Interior);
  const std::size_t middle = cloud.size() / 2;
  cloud.neighbours[middle] = 15;
  const SplatModel model = makeSplatModel(cloud, defaults());
  EXPECT_LT(count(model, SplatRole::Interior), before);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if ((cloud.positions[i] - cloud.positions[middle]).norm() < 2 * cloud.spacing) {
      EXPECT_EQ(model.role(i), SplatRole::Surface);
    }
  }
}

TEST(Interior, SmallSplatsHideNothing) {
  const core::ParticleSnapshot cloud = latticeCloud(9, 9, 9);
  v1::Splats splats = defaults();
  EXPECT_GT(count(makeSplatModel(cloud, splats), SplatRole::Interior), 0U);
  splats.set_radius_in_spacings(0.99 * kLeastRadiusOfInterior);
  EXPECT_TRUE(makeSplatModel(cloud, splats).roles.empty());
  splats = defaults();
  splats.set_skip_interior(false);
  EXPECT_TRUE(makeSplatModel(cloud, splats).roles.empty());
}

TEST(RadiusByDensity, GrowsAsTheLiquidThinsOut) {
  const float alone = 0.1F;
  EXPECT_EQ(radiusByDensity(1, alone, 0.9F, 1), 0.9F);
  EXPECT_EQ(radiusByDensity(1.3F, alone, 0.9F, 1), 0.9F) << "compressed liquid does not shrink";
  EXPECT_NEAR(radiusByDensity(0.5F, alone, 0.9F, 1), 0.9 * std::cbrt(2.0), 1e-6);
  EXPECT_NEAR(radiusByDensity(0.2F, alone, 0.9F, 1), 0.9 * 1.6, 1e-6) << "at most 1.6 times";
}

TEST(RadiusByDensity, AParticleAloneIsABallOfItsVolume) {
  core::ParticleSnapshot cloud = latticeCloud(1, 1, 1);
  const float alone = aloneDensity(cloud);
  const float radius = radiusByDensity(alone, alone, 0.9F, 0.05F);
  EXPECT_NEAR(4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3), std::pow(0.05, 3), 1e-9);
}

TEST(RadiusByDensity, HasNoJumps) {
  float before = radiusByDensity(0.2F, 0.318F, 0.9F, 1);
  for (float density = 0.2F; density < 1.2F; density += 0.001F) {
    const float radius = radiusByDensity(density, 0.318F, 0.9F, 1);
    EXPECT_NEAR(radius, before, 0.01F) << density;
    before = radius;
  }
}

TEST(RadiusByDensity, SmallChangesAreForgotten) {
  core::ParticleSnapshot cloud = latticeCloud(4, 4, 4);
  v1::Splats splats = defaults();
  splats.set_radius_by_density(true);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.densities[i] = 700.0F;
  const SplatModel first = makeSplatModel(cloud, splats);
  // The next snapshot has another order.
  std::mt19937 random(1);
  std::ranges::shuffle(cloud.ids, random);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.densities[i] = cloud.ids[i] == 5 ? 500.0F : 650.0F;
  const SplatModel second = makeSplatModel(cloud, splats, first);
  const SplatModel without = makeSplatModel(cloud, splats);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.ids[i] == 5) {
      EXPECT_EQ(second.radii[i], without.radii[i]) << "a large change is followed";
      EXPECT_GT(second.radii[i], first.radii[0]);
    } else {
      EXPECT_EQ(second.radii[i], first.radii[0]);
      EXPECT_NE(second.radii[i], without.radii[i]);
    }
  }
}

}  // namespace
}  // namespace sluice::render
