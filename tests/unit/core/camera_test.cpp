#include "sluice/core/camera.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace sluice::core {
namespace {

using Eigen::Vector3f;

void expectOrthonormal(const ViewBasis& basis) {
  for (const Vector3f& axis : {basis.right, basis.up, basis.forward}) {
    ASSERT_TRUE(axis.allFinite());
    EXPECT_NEAR(axis.norm(), 1, 1e-5);
  }
  EXPECT_NEAR(basis.right.dot(basis.up), 0, 1e-5);
  EXPECT_NEAR(basis.right.dot(basis.forward), 0, 1e-5);
  EXPECT_LT((basis.right.cross(basis.up) + basis.forward).norm(), 1e-5F);
}

TEST(ViewBasis, LooksFromTheEyeToTheTarget) {
  const ViewBasis basis = viewBasis({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45});
  EXPECT_EQ(basis.forward, Vector3f(0, 0, -1));
  EXPECT_EQ(basis.right, Vector3f(1, 0, 0));
  EXPECT_EQ(basis.up, Vector3f(0, 1, 0));
}

TEST(ViewBasis, IsOrthonormalForEveryFiniteCamera) {
  const std::vector<Camera> cameras{
      {{2, 1.5F, 3}, {0, 0, 0}, {0, 1, 0}, 45},                    // an ordinary one
      {{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 45},                       // eye and target coincide
      {{0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 45},                       // straight down
      {{0, -5, 0}, {0, 0, 0}, {0, 1, 0}, 45},                      // straight up
      {{0, 0, 5}, {0, 0, 0}, {0, 0, 0}, 45},                       // no up at all
      {{0, 0, 5}, {0, 0, 0}, {0, 0, -3}, 45},                      // up along the line of sight
      {{0, 0, 5}, {0, 0, 0}, {1e-7F, 0, 1}, 45},                   // nearly so
      {{1e5F, 1e5F, 1e5F}, {-1e5F, -1e5F, -1e5F}, {0, 1, 0}, 45},  // the ends of the allowed range
      {{1e5F, 0, 0}, {1e5F, 0, 0.0078125F}, {0, 1, 0}, 45},        // a step apart in floats
      {{0, 0, 1e-30F}, {0, 0, 0}, {0, 1, 0}, 45},                  // closer than squares can tell
      {{0, 0, 5}, {0, 0, 0}, {0, 1e-30F, 0}, 45},                  // a short up
  };
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    SCOPED_TRACE(i);
    expectOrthonormal(viewBasis(cameras[i]));
  }
}

TEST(FramingCamera, LooksAtTheMiddleFromTheFrontTheRightAndAbove) {
  for (const Vector3f& size : {Vector3f(1, 1, 1), Vector3f(3, 0.5F, 1), Vector3f(0.1F, 5, 0.1F)}) {
    const Vector3f low(4, -2, 1);
    const Camera camera = framingCamera(low, low + size, 45);
    EXPECT_LT((camera.target - (low + 0.5F * size)).norm(), 1e-5F);
    const Vector3f offset = camera.eye - camera.target;
    EXPECT_GT(offset.minCoeff(), 0);
    // The sphere around the box fills the picture from top to bottom, so that every corner is in it.
    const float halfHeight = offset.norm() * std::sin(0.5F * 45 * std::numbers::pi_v<float> / 180);
    EXPECT_GE(halfHeight, 0.999F * 0.5F * size.norm());
    EXPECT_LT(halfHeight, 1.05F * 0.5F * size.norm());
  }
}

TEST(FramingCamera, TakesABoxThatIsAPoint) {
  const Camera camera = framingCamera({1, 2, 3}, {1, 2, 3});
  EXPECT_EQ(camera.target, Vector3f(1, 2, 3));
  EXPECT_GT((camera.eye - camera.target).norm(), 0);
  expectOrthonormal(viewBasis(camera));
}

}  // namespace
}  // namespace sluice::core
