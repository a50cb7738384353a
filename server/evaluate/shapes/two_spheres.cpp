#include <algorithm>

#include "shapes/ball.h"
#include "shapes/shape.h"

namespace sluice::evaluate {

namespace {

/// Two spheres that overlap: a crease between them, and where the nearer hides the other an edge inside the liquid.
class TwoSpheres : public Shape {
 public:
  std::string_view name() const override { return "two_spheres"; }

  double depthBelow(const Eigen::Vector3d& point) const override {
    return std::max(left_.depthBelow(point), right_.depthBelow(point));
  }

  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const override {
    const std::optional<Hit> left = left_.trace(eye, direction);
    const std::optional<Hit> right = right_.trace(eye, direction);
    if (!left || !right) return left ? left : right;
    return left->distance <= right->distance ? left : right;
  }

  Eigen::AlignedBox3d extent() const override {
    Eigen::AlignedBox3d box;
    for (const Ball& ball : {left_, right_}) {
      box.extend(ball.centre - Eigen::Vector3d::Constant(ball.radius));
      box.extend(ball.centre + Eigen::Vector3d::Constant(ball.radius));
    }
    return box;
  }

 private:
  Ball left_{{-0.45, 0.1, -4.2}, 9 * kShapeSpacing};
  Ball right_{{0.55, -0.15, -3.6}, 7 * kShapeSpacing};
};

}  // namespace

std::unique_ptr<Shape> makeTwoSpheres() { return std::make_unique<TwoSpheres>(); }

}  // namespace sluice::evaluate
