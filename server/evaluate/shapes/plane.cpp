#include <cmath>

#include "shapes/level_axes.h"
#include "shapes/shape.h"

namespace sluice::evaluate {

namespace {

class Plane : public Shape {
 public:
  Plane(std::string_view name, const Eigen::Vector3d& normal) : name_(name), axes_(levelAxes({0, 0, -4}, normal)) {}

  std::string_view name() const override { return name_; }

  double depthBelow(const Eigen::Vector3d& point) const override { return -(axes_.inverse() * point).z(); }

  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const override {
    const Eigen::Vector3d normal = axes_.linear().col(2);
    const double speed = -direction.dot(normal);
    const double height = (eye - axes_.translation()).dot(normal);
    if (speed <= 0 || height < 0) return std::nullopt;
    return Hit{height / speed, normal, 0.0};
  }

  Eigen::Isometry3d axes() const override { return axes_; }

  Eigen::AlignedBox3d extent() const override { return levelExtent(0.0, 3.0 * kShapeSpacing); }

 private:
  std::string_view name_;
  Eigen::Isometry3d axes_;
};

}  // namespace

// A tilted normal; it has y down and z forwards.
std::unique_ptr<Shape> makeTiltedPlane() {
  return std::make_unique<Plane>("plane", Eigen::Vector3d(-0.7, 0.3, 1.0).normalized());
}

std::unique_ptr<Shape> makeFacingPlane() { return std::make_unique<Plane>("plane_facing", Eigen::Vector3d::UnitZ()); }

}  // namespace sluice::evaluate
