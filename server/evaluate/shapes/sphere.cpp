#include "shapes/ball.h"
#include "shapes/shape.h"

namespace sluice::evaluate {

namespace {

/// A sphere of R = 10 d, a little off the middle of the picture.
class Sphere : public Shape {
 public:
  std::string_view name() const override { return "sphere"; }
  double depthBelow(const Eigen::Vector3d& point) const override { return ball_.depthBelow(point); }
  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const override {
    return ball_.trace(eye, direction);
  }
  Eigen::AlignedBox3d extent() const override {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(ball_.radius);
    return {ball_.centre - half, ball_.centre + half};
  }

 private:
  Ball ball_{{0.3, -0.2, -4.0}, 10 * kShapeSpacing};
};

}  // namespace

std::unique_ptr<Shape> makeSphere() { return std::make_unique<Sphere>(); }

}  // namespace sluice::evaluate
