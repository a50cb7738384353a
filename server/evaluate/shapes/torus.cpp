#include <cmath>

#include "shapes/ball.h"
#include "shapes/distance_march.h"
#include "shapes/shape.h"

namespace sluice::evaluate {

namespace {

/// A ring that leans back by 50°, so that its near side hides part of its hole: saddles, and edges inside the liquid.
class Torus : public Shape {
 public:
  std::string_view name() const override { return "torus"; }

  double depthBelow(const Eigen::Vector3d& point) const override {
    const Eigen::Vector3d local = point - middle_;
    const double height = local.dot(axis_);
    const double fromAxis = (local - height * axis_).norm();
    return kTube - std::hypot(fromAxis - kRing, height);
  }

  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const override {
    // The ball around it bounds where the line can meet it.
    const Ball around{middle_, kRing + kTube};
    const double along = (middle_ - eye).dot(direction);
    const std::optional<Hit> entry = around.trace(eye, direction);
    if (!entry) return std::nullopt;
    const auto height = [&](double t) { return -depthBelow(eye + t * direction); };
    const std::optional<double> distance = marchToZero(height, entry->distance, 2 * along - entry->distance);
    if (!distance) return std::nullopt;
    return hitAt(eye + *distance * direction, *distance);
  }

  Eigen::AlignedBox3d extent() const override {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(kRing + kTube);
    return {middle_ - half, middle_ + half};
  }

 private:
  static constexpr double kRing = 10 * kShapeSpacing;
  static constexpr double kTube = 4.5 * kShapeSpacing;

  Hit hitAt(const Eigen::Vector3d& point, double distance) const {
    const Eigen::Vector3d local = point - middle_;
    const double height = local.dot(axis_);
    const Eigen::Vector3d outwards = (local - height * axis_).normalized();
    const Eigen::Vector3d normal = (local - kRing * outwards).normalized();
    // −(R0 + 2r cosθ)/(r(R0 + r cosθ)), θ from the outer equator.
    const double cosine = normal.dot(outwards);
    const double curvature = -(kRing + 2 * kTube * cosine) / (kTube * (kRing + kTube * cosine));
    return {distance, normal, curvature};
  }

  Eigen::Vector3d middle_{0.0, 0.0, -4.0};
  Eigen::Vector3d axis_{0.0, std::sin(0.698), std::cos(0.698)};  // 50° above the line of sight is 40° = 0.698 from it
};

}  // namespace

std::unique_ptr<Shape> makeTorus() { return std::make_unique<Torus>(); }

}  // namespace sluice::evaluate
