#include "metrics/surface_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shapes/shape.h"

namespace sluice::evaluate {
namespace {

constexpr double kEdge = 0.24;

Reference referenceOf(const Shape& shape, const core::Camera& camera, int pixels = 128) {
  Reference reference;
  reference.spacing = kShapeSpacing;
  reference.edge = kEdge;
  reference.surface = traceReference(shape, makeSight(camera, {pixels, pixels}));
  reference.interior = reference.surface.interior(kJudgedMargin, kEdge);
  reference.pictureLiquid = reference.surface.liquid;
  return reference;
}

/// The true surface moved by `offset` metres along its normal, as inverse depths.
std::vector<float> movedSurface(const Reference& reference, double offset) {
  const ReferencePicture& truth = reference.surface;
  std::vector<float> q;
  for (int y = 0; y < truth.sight.size.height; ++y) {
    for (int x = 0; x < truth.sight.size.width; ++x) {
      const std::size_t i = truth.sight.index(x, y);
      // Nearer along the line by offset/cosine, to first order.
      const double nearer = offset / std::max(truth.cosines[i], 0.05F) / truth.sight.line(x, y).norm();
      q.push_back(truth.depths[i] > 0 ? static_cast<float>(1 / (truth.depths[i] - nearer)) : 0.0F);
    }
  }
  return q;
}

SurfaceError errorOf(const std::vector<float>& q, const Reference& reference) {
  return compareSurface(q, geometryOf(q, reference.surface.sight, kEdge), reference);
}

TEST(SurfaceError, TruthHasNone) {
  const auto sphere = makeSphere();
  const Reference reference = referenceOf(*sphere, shapeCamera());
  const SurfaceError error = errorOf(movedSurface(reference, 0), reference);
  EXPECT_GT(error.judgedPixels, 500U);
  EXPECT_LT(error.depthRmseSpacings, 1e-5);
  EXPECT_LT(error.normalRmsDegrees, 0.2);
  EXPECT_LT(error.curvatureResidual, 0.01);
  EXPECT_EQ(error.silhouetteIou, 1);
  EXPECT_EQ(error.hausdorffPixels, 0);
  EXPECT_EQ(error.holes, 0U);
}

TEST(SurfaceError, OffsetIsABiasAndNothingElse) {
  const auto sphere = makeSphere();
  const Reference reference = referenceOf(*sphere, shapeCamera());
  const SurfaceError error = errorOf(movedSurface(reference, 0.3 * kShapeSpacing), reference);
  EXPECT_NEAR(error.depthRmseSpacings, 0.3, 1e-3);
  EXPECT_LT(error.depthRmseUnbiasedSpacings, 1e-3);
}

TEST(SurfaceError, TiltIsTheErrorOfNormals) {
  // A plane that is drawn where it would be if it were turned by a known angle.
  const auto facing = makeFacingPlane();
  const Reference reference = referenceOf(*facing, shapeCamera());
  const Sight& sight = reference.surface.sight;
  const double angle = 3 * 3.14159265358979 / 180;
  std::vector<float> q;
  for (int y = 0; y < sight.size.height; ++y) {
    for (int x = 0; x < sight.size.width; ++x) {
      q.push_back(static_cast<float>((1 + std::tan(angle) * sight.slope(x, y).x()) / 4));
    }
  }
  const SurfaceError error = errorOf(q, reference);
  EXPECT_NEAR(error.normalMeanDegrees, 3, 0.01);
  EXPECT_NEAR(error.normalRmsDegrees, 3, 0.01);
  EXPECT_NEAR(error.normalP95Degrees, 3, 0.02);
}

TEST(SurfaceError, HolesAreCountedInPixelsOfThePicture) {
  const auto plane = makeFacingPlane();
  Reference reference = referenceOf(*plane, shapeCamera());
  std::vector<float> q = movedSurface(reference, 0);
  q[reference.surface.sight.index(64, 64)] = 0;
  q[reference.surface.sight.index(80, 70)] = 0;
  EXPECT_EQ(errorOf(q, reference).holes, 2U);
  reference.divisor = 2;
  reference.pictureLiquid = traceReference(*plane, makeSight(shapeCamera(), {256, 256})).liquid;
  EXPECT_EQ(errorOf(q, reference).holes, 8U);
}

TEST(SurfaceError, EdgesInsideTheLiquidAreNotJudged) {
  const auto spheres = makeTwoSpheres();
  const Reference reference = referenceOf(*spheres, shapeCamera(), 256);
  const Sight& sight = reference.surface.sight;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x + 1 < 256; ++x) {
      const std::size_t i = sight.index(x, y);
      if (!reference.interior.at(x, y)) continue;
      EXPECT_LE(std::abs(reference.surface.depths[i] - reference.surface.depths[i + 1]), kEdge);
      EXPECT_GT(reference.surface.cosines[i], 0.3F);
    }
  }
  EXPECT_GT(reference.interior.count(), 1000U);
}

TEST(Flicker, SteadySurfaceHasNone) {
  const auto sphere = makeSphere();
  const core::Camera away = turned(shapeCamera(), 0.1);
  const Reference here = referenceOf(*sphere, shapeCamera(), 256);
  const Reference there = referenceOf(*sphere, away, 256);
  const std::vector<float> q = movedSurface(here, 0);
  const std::vector<float> turnedQ = movedSurface(there, 0);
  const SurfaceGeometry geometry = geometryOf(q, here.surface.sight, kEdge);
  const SurfaceGeometry turnedGeometry = geometryOf(turnedQ, there.surface.sight, kEdge);
  EXPECT_LT(flickerDegrees(q, geometry, here, turnedQ, turnedGeometry, there.surface.sight), 0.05);
}

TEST(Flicker, ChangedNormalsShow) {
  // Between the pictures every normal turns by 2°.
  const auto plane = makeFacingPlane();
  const Reference reference = referenceOf(*plane, shapeCamera());
  const std::vector<float> q = movedSurface(reference, 0);
  const SurfaceGeometry geometry = geometryOf(q, reference.surface.sight, kEdge);
  SurfaceGeometry turnedGeometry = geometry;
  const float angle = 2 * 3.14159265F / 180;
  for (Eigen::Vector3f& n : turnedGeometry.normals) n = {std::sin(angle), 0, -std::cos(angle)};
  EXPECT_NEAR(flickerDegrees(q, geometry, reference, q, turnedGeometry, reference.surface.sight), 2, 1e-3);
}

}  // namespace
}  // namespace sluice::evaluate
