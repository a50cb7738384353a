#include <cmath>

#include "shapes/shape.h"

namespace sluice::evaluate {

namespace {

/// A cylinder of R = 8 d that lies askew across the picture and ends outside of it.
class Cylinder : public Shape {
 public:
  std::string_view name() const override { return "cylinder"; }

  double depthBelow(const Eigen::Vector3d& point) const override { return kRadius - fromAxis(point - middle_).norm(); }

  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const override {
    const Eigen::Vector3d from = fromAxis(eye - middle_);
    const Eigen::Vector3d across = fromAxis(direction);
    const double a = across.squaredNorm();
    const double b = from.dot(across);
    const double squared = b * b - a * (from.squaredNorm() - kRadius * kRadius);
    if (squared < 0 || a == 0) return std::nullopt;
    const double distance = (-b - std::sqrt(squared)) / a;
    if (distance < 0) return std::nullopt;
    return Hit{distance, (from + distance * across) / kRadius, -1.0 / kRadius};
  }

  Eigen::Isometry3d axes() const override {
    Eigen::Isometry3d axes = Eigen::Isometry3d::Identity();
    const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(axis_).normalized();
    axes.linear() << axis_, y, axis_.cross(y);
    axes.translation() = middle_;
    return axes;
  }

  Eigen::AlignedBox3d extent() const override {
    constexpr double kHalfLength = 4.0;  // m; a picture of 45° sees 1.7 m to either side from 4 m away
    return {Eigen::Vector3d(-kHalfLength, -kRadius, -kRadius), Eigen::Vector3d(kHalfLength, kRadius, kRadius)};
  }

 private:
  static constexpr double kRadius = 8 * kShapeSpacing;

  Eigen::Vector3d fromAxis(const Eigen::Vector3d& v) const { return v - axis_ * axis_.dot(v); }

  Eigen::Vector3d middle_{0.0, 0.0, -4.0};
  Eigen::Vector3d axis_ = Eigen::Vector3d(1.0, 0.3, 0.25).normalized();
};

}  // namespace

std::unique_ptr<Shape> makeCylinder() { return std::make_unique<Cylinder>(); }

}  // namespace sluice::evaluate
