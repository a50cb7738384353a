#include "shapes/shape.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "metrics/sight.h"

namespace sluice::evaluate {
namespace {

/// The first crossing that small steps along the line find, m; none where there is none.
std::optional<double> walkTo(const Shape& shape, const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) {
  constexpr double kStep = 2e-3;
  constexpr double kFar = 12;
  if (shape.depthBelow(eye) > 0) return std::nullopt;
  for (double t = kStep; t < kFar; t += kStep) {
    if (shape.depthBelow(eye + t * direction) > 0) return t;
  }
  return std::nullopt;
}

TEST(Shapes, LinesMeetThemWhereStepsDo) {
  const Sight sight = makeSight(shapeCamera(), {40, 40});
  for (const auto& shape : makeShapes()) {
    int met = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        const Eigen::Vector3d direction = (sight.toWorld * sight.line(x, y)).normalized();
        const auto hit = shape->trace(sight.eye, direction);
        const auto walked = walkTo(*shape, sight.eye, direction);
        if (!walked) {
          // A line that grazes by less than a step's reach may be walked past.
          if (hit) {
            EXPECT_GT(hit->normal.dot(direction), -0.08) << shape->name() << " at " << x << ", " << y;
          }
          continue;
        }
        ASSERT_TRUE(hit) << shape->name() << " at " << x << ", " << y;
        EXPECT_NEAR(hit->distance, *walked, 2.1e-3) << shape->name() << " at " << x << ", " << y;
        ++met;
      }
    }
    EXPECT_GT(met, 300) << shape->name();
  }
}

TEST(Shapes, NormalsAreWhereTheDepthFalls) {
  const Sight sight = makeSight(shapeCamera(), {24, 24});
  constexpr double kStep = 1e-5;
  for (const auto& shape : makeShapes()) {
    for (int i = 0; i < 24 * 24; ++i) {
      const Eigen::Vector3d direction = (sight.toWorld * sight.line(i % 24, i / 24)).normalized();
      const auto hit = shape->trace(sight.eye, direction);
      if (!hit) continue;
      const Eigen::Vector3d point = sight.eye + hit->distance * direction;
      Eigen::Vector3d out;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
        out[axis] = (shape->depthBelow(point - step) - shape->depthBelow(point + step)) / (2 * kStep);
      }
      EXPECT_NEAR(hit->normal.norm(), 1, 1e-9);
      EXPECT_LT((hit->normal - out.normalized()).norm(), 1e-3) << shape->name() << " at pixel " << i;
      EXPECT_LT(hit->normal.dot(direction), 1e-6) << shape->name();
    }
  }
}

TEST(Shapes, DepthIsADistance) {
  // Its gradient has length 1 near the surface.
  for (const auto& shape : makeShapes()) {
    const Sight sight = makeSight(shapeCamera(), {12, 12});
    for (int i = 0; i < 144; ++i) {
      const Eigen::Vector3d direction = (sight.toWorld * sight.line(i % 12, i / 12)).normalized();
      const auto hit = shape->trace(sight.eye, direction);
      if (!hit) continue;
      const Eigen::Vector3d point = sight.eye + hit->distance * direction - 0.03 * hit->normal;
      EXPECT_NEAR(shape->depthBelow(point), 0.03, 2e-3) << shape->name();
    }
  }
}

TEST(Shapes, ParticlesFillThemUpToHalfASpacing) {
  // Where the plane ends: the outermost layer is half a spacing deep on average, within a quarter.
  const auto plane = makeTiltedPlane();
  const core::ParticleSnapshot particles = fillShape(*plane, 1);
  double sum = 0;
  double least = 1;
  int outermost = 0;
  for (const Eigen::Vector3f& p : particles.positions) {
    const double depth = plane->depthBelow(p.cast<double>());
    least = std::min(least, depth);
    if (depth > kShapeSpacing) continue;
    sum += depth;
    ++outermost;
  }
  EXPECT_GE(least, 0.2499 * kShapeSpacing);
  EXPECT_NEAR(sum / outermost, 0.5 * kShapeSpacing, 0.01 * kShapeSpacing);
}

TEST(Shapes, ParticlesHaveTheVolumeOfTheirCells) {
  // A ball of 10 d without its outermost quarter of a spacing.
  const auto sphere = makeSphere();
  const double cells = 4.0 / 3.0 * 3.14159265358979 * std::pow(9.75, 3);
  EXPECT_NEAR(static_cast<double>(fillShape(*sphere, 1).size()), cells, 0.02 * cells);
}

TEST(Shapes, SameSeedGivesTheSameParticles) {
  const auto torus = makeTorus();
  EXPECT_EQ(fillShape(*torus, 4).positions, fillShape(*torus, 4).positions);
  EXPECT_NE(fillShape(*torus, 4).positions, fillShape(*torus, 5).positions);
}

TEST(Shapes, NamesDiffer) {
  std::map<std::string_view, int> names;
  for (const auto& shape : makeShapes()) EXPECT_EQ(++names[shape->name()], 1) << shape->name();
}

TEST(Sight, PixelsGoToTheirPointsAndBack) {
  const Sight sight = makeSight(shapeCamera(), {64, 48});
  const Eigen::Vector3d world = sight.eye + sight.toWorld * (3.5 * sight.line(50, 7));
  const Eigen::Vector3d view = sight.toView(world);
  EXPECT_NEAR(view.z(), 3.5, 1e-9);
  EXPECT_LT((sight.toPixel(view) - Eigen::Vector2d(50, 7)).norm(), 1e-9);
}

TEST(Sight, RowsGoDown) {
  const Sight sight = makeSight(shapeCamera(), {64, 48});
  EXPECT_GT((sight.toWorld * sight.line(32, 0)).y(), 0) << "the first row looks up";
  EXPECT_GT((sight.toWorld * sight.line(63, 24)).x(), 0);
}

TEST(Sight, TurningKeepsTheDistance) {
  const core::Camera camera = shapeCamera();
  const core::Camera other = turned(camera, 0.1);
  EXPECT_NEAR((other.eye - other.target).norm(), (camera.eye - camera.target).norm(), 1e-5);
  EXPECT_NEAR((other.eye - camera.eye).norm(), 4 * 0.1 * 3.14159 / 180, 1e-5);
}

}  // namespace
}  // namespace sluice::evaluate
