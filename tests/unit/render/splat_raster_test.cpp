// Splats drawn on the CPU, against the obvious way of crossing them with lines of sight.
#include "splat_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace sluice::render {
namespace {

const ViewGeometry kView = makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 60.0F}, {150, 110});

Eigen::Vector3d lineOfSight(int x, int y) {
  return {kView.pixelSlope * (x + 0.5 - 0.5 * kView.size.width), kView.pixelSlope * (y + 0.5 - 0.5 * kView.size.height),
          1.0};
}

std::vector<float> emptyPicture() {
  return std::vector<float>(static_cast<std::size_t>(kView.size.width) * static_cast<std::size_t>(kView.size.height));
}

ViewSphere sphere(float x, float y, float z, float radius) { return {x, y, z, radius}; }

ViewEllipsoid ballOf(const ViewSphere& s) {
  const float r2 = s.radius * s.radius;
  return {s.x, s.y, s.z, s.radius, r2, r2, r2, 0, 0, 0};
}

std::vector<ViewSphere> someSpheres() {
  return {sphere(0, 0, 3, 0.4F), sphere(1.2F, -0.7F, 3, 0.3F), sphere(-0.9F, 0.5F, 2, 0.05F),
          sphere(0.1F, 0.2F, 40, 0.01F), sphere(-1.5F, -1.1F, 2.5F, 0.6F)};
}

/// Ellipsoids turned and stretched at random.
std::vector<ViewEllipsoid> someEllipsoids() {
  std::mt19937 random(4);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) / static_cast<float>(1U << 24);
  };
  std::vector<ViewEllipsoid> ellipsoids;
  for (int i = 0; i < 40; ++i) {
    Eigen::Matrix3f directions = Eigen::Quaternionf(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1F, 1))
                                     .normalized()
                                     .toRotationMatrix();
    const Eigen::Vector3f axes(uniform(0.05F, 0.5F), uniform(0.05F, 0.5F), uniform(0.05F, 0.5F));
    const Eigen::Matrix3f s = directions * axes.cwiseAbs2().asDiagonal() * directions.transpose();
    const float z = uniform(1, 4);
    ellipsoids.push_back({uniform(-0.5F, 0.5F) * z, uniform(-0.4F, 0.4F) * z, z, axes.minCoeff(), s(0, 0), s(1, 1),
                          s(2, 2), s(0, 1), s(0, 2), s(1, 2)});
  }
  return ellipsoids;
}

/// Both depths at which a line of sight crosses an ellipsoid, nearest first, in doubles; none where it misses or just
/// touches.
struct Depths {
  double front = 0, back = 0, discriminant = -1;
};

Depths cross(const ViewEllipsoid& e, const Eigen::Vector3d& w) {
  Eigen::Matrix3d s;
  s << e.xx, e.xy, e.xz, e.xy, e.yy, e.yz, e.xz, e.yz, e.zz;
  const Eigen::Matrix3d q = s.inverse();
  const Eigen::Vector3d c(e.x, e.y, e.z);
  const double a = w.dot(q * w);
  const double m = w.dot(q * c);
  const double d = m * m - a * (c.dot(q * c) - 1);
  if (d < 0) return {};
  return {(m - std::sqrt(d)) / a, (m + std::sqrt(d)) / a, d / a};
}

TEST(SplatRaster, EllipsoidsHaveTheirExactDepth) {
  const std::vector<ViewEllipsoid> ellipsoids = someEllipsoids();
  std::vector<float> q = emptyPicture();
  SplatRaster().drawDepth(ellipsoids, kView, 0.0F, q);
  int hits = 0;
  int outlines = 0;
  for (int y = 0; y < kView.size.height; ++y) {
    for (int x = 0; x < kView.size.width; ++x) {
      double nearest = 1e9;
      bool onOutline = false;
      for (const ViewEllipsoid& e : ellipsoids) {
        const Depths depths = cross(e, lineOfSight(x, y));
        if (depths.discriminant < 0) continue;
        onOutline = onOutline || depths.discriminant < 1e-4;
        nearest = std::min(nearest, depths.front);
      }
      const float drawn = q[static_cast<std::size_t>(y * kView.size.width + x)];
      outlines += onOutline ? 1 : 0;
      if (onOutline) continue;
      ASSERT_NEAR(drawn, nearest < 1e9 ? 1 / nearest : 0.0, 1e-4 * drawn) << x << ", " << y;
      hits += drawn > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 5000);
  EXPECT_LT(outlines, 50);
}

TEST(SplatRaster, EllipsoidsAreAsThickAsTheyAre) {
  const std::vector<ViewEllipsoid> ellipsoids = someEllipsoids();
  std::vector<float> thickness = emptyPicture();
  const float particleVolume = 0.01F;
  SplatRaster().drawThickness(ellipsoids, kView, particleVolume, thickness);
  for (int y = 0; y < kView.size.height; ++y) {
    for (int x = 0; x < kView.size.width; ++x) {
      const Eigen::Vector3d w = lineOfSight(x, y);
      double sum = 0;
      for (const ViewEllipsoid& e : ellipsoids) {
        const Depths depths = cross(e, w);
        Eigen::Matrix3d s;
        s << e.xx, e.xy, e.xz, e.xy, e.yy, e.yz, e.xz, e.yz, e.zz;
        const double volume = 4.0 / 3.0 * std::numbers::pi * std::sqrt(s.determinant());
        sum += particleVolume / volume * (depths.back - depths.front) * w.norm();
      }
      ASSERT_NEAR(thickness[static_cast<std::size_t>(y * kView.size.width + x)], sum, 1e-3 * sum + 1e-3)
          << x << ", " << y;
    }
  }
}

TEST(SplatRaster, EllipsoidsOfEqualAxesAreSpheres) {
  const std::vector<ViewSphere> spheres = someSpheres();
  std::vector<ViewEllipsoid> balls;
  for (const ViewSphere& s : spheres) balls.push_back(ballOf(s));
  for (const float rimDepth : {0.0F, 0.83F}) {
    std::vector<float> ofSpheres = emptyPicture();
    std::vector<float> ofBalls = emptyPicture();
    SplatRaster().drawDepth(spheres, kView, rimDepth, ofSpheres);
    SplatRaster().drawDepth(balls, kView, rimDepth, ofBalls);
    int hits = 0;
    int outlines = 0;
    for (std::size_t i = 0; i < ofSpheres.size(); ++i) {
      if ((ofSpheres[i] > 0) != (ofBalls[i] > 0)) {
        ++outlines;  // the last bit decides whether such a pixel is met
        continue;
      }
      hits += ofSpheres[i] > 0 ? 1 : 0;
      // Near the outline the root magnifies round-off.
      ASSERT_NEAR(ofBalls[i], ofSpheres[i], 2e-5F * ofSpheres[i]) << i;
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LE(outlines, 2);
  }
  std::vector<float> ofSpheres = emptyPicture();
  std::vector<float> ofBalls = emptyPicture();
  SplatRaster().drawThickness(spheres, kView, 0.01F, ofSpheres);
  SplatRaster().drawThickness(balls, kView, 0.01F, ofBalls);
  for (std::size_t i = 0; i < ofSpheres.size(); ++i)
    ASSERT_NEAR(ofBalls[i], ofSpheres[i], 1e-4F * ofSpheres[i] + 1e-5F);
}

TEST(SplatRaster, RimsLieBetweenFrontsAndTheEye) {
  // Nowhere farther than the front, and nowhere nearer than the rim's distance.
  const std::vector<ViewEllipsoid> ellipsoids = someEllipsoids();
  for (const ViewEllipsoid& e : ellipsoids) {
    std::vector<float> plain = emptyPicture();
    std::vector<float> flat = emptyPicture();
    SplatRaster().drawDepth(std::span(&e, 1), kView, 0.0F, plain);
    SplatRaster().drawDepth(std::span(&e, 1), kView, 0.83F, flat);
    float nearest = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      ASSERT_EQ(plain[i] > 0, flat[i] > 0);
      ASSERT_GE(flat[i], plain[i]);
      nearest = std::max(nearest, plain[i]);
    }
    EXPECT_GT(nearest, 0.0F);
  }
}

TEST(SplatRaster, DiscsAreFlatAndRound) {
  // Eq. (2) of Cords & Staadt gives the diameter in pixels; the radius is R/(C·z).
  const ViewSphere disc = sphere(0.9F, -0.4F, 2.5F, 0.3F);
  std::vector<float> q = emptyPicture();
  SplatRaster().drawDiscDepth(std::span(&disc, 1), kView, q);
  const double radius = disc.radius / (kView.pixelSlope * disc.z);
  const Eigen::Vector2f centre = kView.toPixel(Eigen::Vector2f(disc.x, disc.y) / disc.z);
  int hits = 0;
  for (int y = 0; y < kView.size.height; ++y) {
    for (int x = 0; x < kView.size.width; ++x) {
      const float drawn = q[static_cast<std::size_t>(y * kView.size.width + x)];
      const double distance = std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y());
      if (std::abs(distance - radius) < 1e-3) continue;
      ASSERT_EQ(drawn, distance < radius ? 1 / disc.z : 0.0F) << x << ", " << y;
      hits += drawn > 0 ? 1 : 0;
    }
  }
  EXPECT_NEAR(hits, std::numbers::pi * radius * radius, 0.03 * std::numbers::pi * radius * radius);
}

TEST(ViewSplats, BoundsTouchTheEllipsoid) {
  for (const ViewEllipsoid& e : someEllipsoids()) {
    const SlopeBounds bounds = boundsOf(e);
    // Just outside no line of sight meets it; just inside one does.
    for (const int axis : {0, 1}) {
      for (const float side : {-1.0F, 1.0F}) {
        int inside = 0;
        int outside = 0;
        for (int step = -400; step <= 400; ++step) {
          Eigen::Vector3d w(0, 0, 1);
          w(1 - axis) = bounds.centre(1 - axis) + bounds.halfExtent(1 - axis) * step / 400.0;
          w(axis) = bounds.centre(axis) + 0.998 * side * bounds.halfExtent(axis);
          inside += cross(e, w).discriminant >= 0 ? 1 : 0;
          w(axis) = bounds.centre(axis) + 1.002 * side * bounds.halfExtent(axis);
          outside += cross(e, w).discriminant >= 0 ? 1 : 0;
        }
        EXPECT_GT(inside, 0);
        EXPECT_EQ(outside, 0);
      }
    }
  }
}

TEST(ViewSplats, FarEllipsoidsKeepTheSizeOfAPixel) {
  const ViewEllipsoid tiny = ballOf(sphere(0.3F, 0.2F, 50, 0.001F));
  const ViewEllipsoid wide = widened(tiny, kView.pixelSlope);
  const ViewSphere asSphere = widened(sphere(0.3F, 0.2F, 50, 0.001F), kView.pixelSlope);
  EXPECT_FLOAT_EQ(wide.xx, asSphere.radius * asSphere.radius);
  EXPECT_FLOAT_EQ(wide.shortest, asSphere.radius);
  std::vector<float> q = emptyPicture();
  SplatRaster().drawDepth(std::span(&tiny, 1), kView, 0.0F, q);
  EXPECT_GT(*std::ranges::max_element(q), 0.0F);
}

}  // namespace
}  // namespace sluice::render
