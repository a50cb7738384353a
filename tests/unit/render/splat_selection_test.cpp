#include "splat_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "column_and_sheet.h"
#include "sluice/render/frame_plan.h"
#include "sluice/scene/scene.h"
#include "splat_raster.h"

namespace sluice::render {
namespace {

SplatLimits limits(float radius) {
  SplatLimits result;
  result.radius = radius;
  result.nearDepth = 0.1F * radius;
  result.maxPointPixels = 255;
  return result;
}

TEST(SphereBounds, TouchTheOutline) {
  std::mt19937 random(1);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) / static_cast<float>(1U << 24);
  };
  for (int round = 0; round < 20; ++round) {
    const Eigen::Vector3f centre(uniform(-3, 3), uniform(-3, 3), uniform(1, 4));
    const float radius = uniform(0.05F, 0.9F);
    const SlopeBounds bounds = sphereBounds(centre, radius);
    // Slopes of the circle along which lines of sight touch the sphere.
    const Eigen::Vector3f axis = centre.normalized();
    const Eigen::Vector3f u = axis.unitOrthogonal();
    const Eigen::Vector3f v = axis.cross(u);
    const float distance = centre.norm();
    const float along = distance - radius * radius / distance;
    const float across = radius * std::sqrt(1.0F - radius * radius / (distance * distance));
    Eigen::Array2f low = Eigen::Array2f::Constant(1e9F);
    Eigen::Array2f high = -low;
    for (int i = 0; i < 20000; ++i) {
      const float angle = 6.2831853F * static_cast<float>(i) / 20000.0F;
      const Eigen::Vector3f p = along * axis + across * (std::cos(angle) * u + std::sin(angle) * v);
      const Eigen::Array2f w = p.head<2>().array() / p.z();
      low = low.min(w);
      high = high.max(w);
    }
    const Eigen::Array2f expectedCentre = 0.5F * (low + high);
    const float tolerance = 1e-4F * (1.0F + high.abs().maxCoeff() + low.abs().maxCoeff());
    EXPECT_TRUE(((bounds.centre.array() - expectedCentre).abs() < tolerance).all());
    EXPECT_TRUE(((bounds.halfExtent.array() - 0.5F * (high - low)).abs() < tolerance).all());
  }
}

/// The slow, obvious way: the nearest sphere along every line of sight.
std::vector<float> nearestDepths(const std::vector<Eigen::Vector3f>& positions, const std::vector<std::uint32_t>& drawn,
                                 const ViewGeometry& view, float radius) {
  std::vector<float> depths;
  for (int y = 0; y < view.size.height; ++y) {
    for (int x = 0; x < view.size.width; ++x) {
      const Eigen::Vector2f w =
          (Eigen::Vector2f(x + 0.5F, y + 0.5F) - 0.5F * Eigen::Vector2f(view.size.width, view.size.height)) *
          view.pixelSlope;
      const Eigen::Vector3d ray(w.x(), w.y(), 1.0);
      double nearest = 1e9;
      for (const std::uint32_t index : drawn) {
        const Eigen::Vector3d c = view.toView(positions[index]).cast<double>();
        const double b = ray.dot(c);
        const double discriminant = b * b - ray.squaredNorm() * (c.squaredNorm() - radius * radius);
        if (discriminant >= 0) nearest = std::min(nearest, (b - std::sqrt(discriminant)) / ray.squaredNorm());
      }
      depths.push_back(static_cast<float>(nearest));
    }
  }
  return depths;
}

TEST(SelectSplats, LeavingOutTheHiddenChangesNoPixel) {
  const core::ParticleSnapshot particles = testing::columnAndSheet(4000);
  const ViewGeometry view = makeViewGeometry(testing::columnAndSheetCamera(), {120, 90});
  const auto radius = static_cast<float>(0.9 * particles.spacing);
  const SplatSelection selection = selectSplats(particles.positions, {}, view, limits(radius));
  EXPECT_LT(selection.visible.size(), selection.points.size()) << "nothing is hidden: this shows nothing";
  EXPECT_TRUE(selection.large.empty());
  EXPECT_EQ(nearestDepths(particles.positions, selection.visible.particles, view, radius),
            nearestDepths(particles.positions, selection.points.particles, view, radius));
}

TEST(SelectSplats, LeavingOutTheHiddenChangesNoBitOfAnyShape) {
  core::ParticleSnapshot particles = testing::columnAndSheet(4000);
  const ViewGeometry view = makeViewGeometry(testing::columnAndSheetCamera(), {160, 120});
  const auto radius = static_cast<float>(0.9 * particles.spacing);
  for (const char* shape : {"sphere", "ellipsoid", "disc"}) {
    v1::Splats splats;
    splats.GetReflection()->MutableMessage(&splats, v1::Splats::descriptor()->FindFieldByName(shape));
    scene::complete(splats);
    const SplatModel model = makeSplatModel(particles, splats);
    const SplatSelection selection = selectSplats(particles.positions, model, view, limits(radius));
    EXPECT_LT(selection.visible.size(), selection.points.size()) << "nothing is hidden: this shows nothing";
    for (const float rimDepth : {0.0F, kRimDepth}) {
      const auto draw = [&](const SplatList& list) {
        std::vector<float> q(160 * 120);
        SplatRaster raster;
        if (model.shape == SplatShape::Sphere) raster.drawDepth(list.spheres, view, rimDepth, q);
        if (model.shape == SplatShape::Ellipsoid) raster.drawDepth(list.ellipsoids, view, rimDepth, q);
        if (model.shape == SplatShape::Disc) raster.drawDiscDepth(list.spheres, view, q);
        return q;
      };
      EXPECT_EQ(draw(selection.visible), draw(selection.points)) << shape << " with rims at " << rimDepth;
    }
  }
}

TEST(SelectSplats, EveryParticleInThePictureIsListedOnce) {
  const core::ParticleSnapshot particles = testing::columnAndSheet(4000);
  const ViewGeometry view = makeViewGeometry(testing::columnAndSheetCamera(), {320, 240});
  const SplatSelection selection = selectSplats(particles.positions, {}, view, limits(0.05F));
  EXPECT_TRUE(std::ranges::is_sorted(selection.points.particles, std::ranges::less_equal{}));
  EXPECT_EQ(selection.points.size(), particles.size());
}

TEST(SelectSplats, DropsWhatIsBehindOrBeside) {
  const ViewGeometry view = makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45.0F}, {100, 100});
  const std::vector<Eigen::Vector3f> positions{{0, 0, 5}, {50, 0, -5}, {0, -50, -5}, {0, 0, -5}};
  const SplatSelection selection = selectSplats(positions, {}, view, limits(0.1F));
  EXPECT_EQ(selection.points.particles, std::vector<std::uint32_t>{3});
  EXPECT_TRUE(selection.large.empty());
  EXPECT_NEAR(selection.nearestDepth, 4.9F, 1e-5F);
}

TEST(SelectSplats, SpheresAtTheEyeAreLarge) {
  const ViewGeometry view = makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45.0F}, {200, 200});
  const std::vector<Eigen::Vector3f> positions{{0, 0, 0}, {0, 0, -0.1F}, {0, 0, -0.15F}};
  const SplatSelection selection = selectSplats(positions, {}, view, limits(0.1F));
  EXPECT_EQ(selection.points.size(), 0U);
  EXPECT_EQ(selection.large.size(), 3U);
  EXPECT_EQ(selection.nearestDepth, limits(0.1F).nearDepth);
}

}  // namespace
}  // namespace sluice::render
