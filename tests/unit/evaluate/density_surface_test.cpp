#include "shapes/density_surface.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "shapes/shape.h"

namespace sluice::evaluate {
namespace {

constexpr double kSpacing = 0.1;

/// A lattice −n…n along every axis.
std::vector<Eigen::Vector3f> block(int n) {
  std::vector<Eigen::Vector3f> positions;
  for (int z = -n; z <= n; ++z) {
    for (int y = -n; y <= n; ++y) {
      for (int x = -n; x <= n; ++x) positions.push_back(static_cast<float>(kSpacing) * Eigen::Vector3f(x, y, z));
    }
  }
  return positions;
}

TEST(DensitySurface, LiquidFillsItsVolume) {
  const DensitySurface surface(block(6), kSpacing);
  EXPECT_NEAR(surface.fraction({0, 0, 0}), 1, 0.03);
  EXPECT_EQ(surface.fraction({2, 0, 0}), 0);
}

TEST(DensitySurface, FractionMatchesASumOverAll) {
  const std::vector<Eigen::Vector3f> positions = block(4);
  const DensitySurface surface(positions, kSpacing);
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(0.42, 0.1, -0.3), Eigen::Vector3d(-0.5, -0.5, 0.5), Eigen::Vector3d(0.03, 0.01, 0.02)}) {
    double sum = 0;
    const double H = 2.5 * kSpacing;
    for (const Eigen::Vector3f& p : positions) {
      const double x = (at - p.cast<double>()).norm() / H;
      if (x >= 1) continue;
      sum += x <= 0.5 ? 6 * (x * x * x - x * x) + 1 : 2 * std::pow(1 - x, 3);
    }
    EXPECT_NEAR(surface.fraction(at), sum * 8 / 3.14159265358979 / std::pow(2.5, 3), 1e-9);
  }
}

TEST(DensitySurface, GradientIsThatOfTheFraction) {
  const DensitySurface surface(block(4), kSpacing);
  const Eigen::Vector3d at(0.42, 0.13, -0.31);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
    const double slope = (surface.fraction(at + step) - surface.fraction(at - step)) / 2e-6;
    EXPECT_NEAR(surface.gradient(at)[axis], slope, 1e-5);
  }
}

TEST(DensitySurface, StandsHalfASpacingOutsideItsParticles) {
  const DensitySurface surface(block(8), kSpacing);
  const auto hit = surface.trace({0.013, 0.024, 3}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(3 - hit->distance, 8.5 * kSpacing, 0.05 * kSpacing);
  EXPECT_GT(hit->normal.z(), 0.995);
  EXPECT_NEAR(hit->curvature * kSpacing, 0, 0.08);
}

TEST(DensitySurface, BallHasItsRadiusAndCurvature) {
  const auto sphere = makeSphere();
  const DensitySurface surface(fillShape(*sphere, 1).positions, kSpacing);
  const Eigen::Vector3d middle(0.3, -0.2, -4);
  double radius = 0;
  double curvature = 0;
  const int n = 60;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d out(std::cos(i), std::sin(i), std::sin(0.7 * i) * 0.5);
    const auto hit = surface.trace(middle + 2 * out.normalized(), -out.normalized());
    ASSERT_TRUE(hit);
    radius += (2 - hit->distance) / n;
    curvature += hit->curvature / n;
  }
  // The outermost quarter of a spacing of the sphere holds no particles.
  EXPECT_NEAR(radius, 9.75 * kSpacing, 0.15 * kSpacing);
  EXPECT_NEAR(curvature, -2 / radius, 0.6);
}

TEST(DensitySurface, MissesWhatIsNotThere) {
  const DensitySurface surface(block(3), kSpacing);
  EXPECT_FALSE(surface.trace({2, 0, 3}, {0, 0, -1}));
  EXPECT_FALSE(surface.trace({0, 0, 3}, {0, 0, 1})) << "behind the eye";
  EXPECT_FALSE(DensitySurface({}, kSpacing).trace({0, 0, 3}, {0, 0, -1}));
}

TEST(DensitySurface, SheetOfOneParticleHasASurface) {
  std::vector<Eigen::Vector3f> sheet;
  for (int i = 0; i < 400; ++i)
    sheet.emplace_back(0.1F * static_cast<float>(i % 20), 0.1F * static_cast<float>(i / 20), 0.0F);
  EXPECT_TRUE(DensitySurface(sheet, kSpacing).trace({1.0, 1.0, 1.0}, {0, 0, -1}));
}

}  // namespace
}  // namespace sluice::evaluate
