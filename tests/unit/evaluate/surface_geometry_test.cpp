// Differences of inverse depths against surfaces whose normals and curvatures are known.
#include "metrics/surface_geometry.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "metrics/reference_picture.h"
#include "shapes/shape.h"

namespace sluice::evaluate {
namespace {

/// The shape's exact picture as a renderer would hold it.
std::vector<float> inverseDepths(const ReferencePicture& picture) {
  std::vector<float> q;
  for (const double z : picture.depths) q.push_back(z > 0 ? static_cast<float>(1 / z) : 0.0F);
  return q;
}

constexpr double kEdge = 0.24;  // m

struct Errors {
  double normalDegrees = 0;  ///< RMS.
  double curvature = 0;      ///< RMS, in 1/d.
};

Errors errorsOf(const Shape& shape, int pixels) {
  const ReferencePicture truth = traceReference(shape, makeSight(shapeCamera(), {pixels, pixels}));
  const SurfaceGeometry geometry = geometryOf(inverseDepths(truth), truth.sight, kEdge);
  const Mask interior = truth.interior(4, kEdge);
  double angles = 0;
  double bends = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < interior.set.size(); ++i) {
    if (interior.set[i] == 0) continue;
    const double sine = geometry.normals[i].cross(truth.normals[i]).norm();
    angles += std::pow(std::asin(std::min(sine, 1.0)) * 57.29577951308232, 2);
    bends += std::pow((geometry.curvatures[i] - truth.curvatures[i]) * kShapeSpacing, 2);
    ++n;
  }
  EXPECT_GT(n, 1000U) << shape.name();
  return {std::sqrt(angles / static_cast<double>(n)), std::sqrt(bends / static_cast<double>(n))};
}

TEST(SurfaceGeometry, NormalsOfABallAreItsOwn) {
  // A published check has 0.0123° at 512² for a ball of the same R/z; single precision adds its rounding.
  EXPECT_LT(errorsOf(*makeSphere(), 512).normalDegrees, 0.05);
  EXPECT_LT(errorsOf(*makeSphere(), 256).normalDegrees, 0.1);
}

TEST(SurfaceGeometry, NormalsOfAPlaneAreExactUpToRounding) {
  EXPECT_LT(errorsOf(*makeTiltedPlane(), 256).normalDegrees, 0.005);
  EXPECT_LT(errorsOf(*makeFacingPlane(), 256).normalDegrees, 0.005);
}

TEST(SurfaceGeometry, CurvaturesHaveTheirSignAndSize) {
  // A ball of 10 d has −0.2/d, the cylinder of 8 d −0.125/d.
  for (const auto& shape : {makeSphere(), makeCylinder(), makeTorus(), makeWave()}) {
    EXPECT_LT(errorsOf(*shape, 256).curvature, 0.02) << shape->name();
  }
}

TEST(SurfaceGeometry, EdgesAreNotDifferencedAcross) {
  // Two level surfaces, one metre apart: both keep their normals up to the step.
  const Sight sight = makeSight(shapeCamera(), {32, 32});
  std::vector<float> q(sight.pixels());
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) q[sight.index(x, y)] = x < 16 ? 0.25F : 0.2F;
  }
  const SurfaceGeometry geometry = geometryOf(q, sight, kEdge);
  for (int x = 0; x < 32; ++x) {
    EXPECT_NEAR(geometry.normals[sight.index(x, 15)].z(), -1, 1e-6) << x;
  }
  EXPECT_TRUE(std::isnan(geometry.curvatures[sight.index(15, 15)]));
  EXPECT_FALSE(std::isnan(geometry.curvatures[sight.index(13, 15)]));
}

TEST(SurfaceGeometry, NoLiquidHasNoNormal) {
  const Sight sight = makeSight(shapeCamera(), {4, 4});
  std::vector<float> q(sight.pixels(), 0.0F);
  q[5] = 0.25F;
  const SurfaceGeometry geometry = geometryOf(q, sight, kEdge);
  EXPECT_TRUE(geometry.normals[0].isZero());
  EXPECT_NEAR(geometry.normals[5].norm(), 1, 1e-6);
}

}  // namespace
}  // namespace sluice::evaluate
