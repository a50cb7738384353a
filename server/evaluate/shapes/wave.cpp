#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes/distance_march.h"
#include "shapes/level_axes.h"
#include "shapes/shape.h"

namespace sluice::evaluate {

namespace {

/// Swell of 20 d wavelength and 1.5 d amplitude on a level that leans back by 35°: h = a·sin(kx).
class Wave : public Shape {
 public:
  std::string_view name() const override { return "wave"; }

  double depthBelow(const Eigen::Vector3d& point) const override {
    const Eigen::Vector3d local = axes_.inverse() * point;
    const double x = nearestCrestwise(local.x(), local.z());
    const double distance = std::hypot(x - local.x(), height(x) - local.z());
    return local.z() <= height(local.x()) ? distance : -distance;
  }

  std::optional<Hit> trace(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) const override {
    const Eigen::Vector3d from = axes_.inverse() * eye;
    const Eigen::Vector3d along = axes_.linear().transpose() * direction;
    if (along.z() >= 0) return std::nullopt;  // the eye is above the crests
    const double near = (from.z() - kAmplitude) / -along.z();
    const double far = (from.z() + kAmplitude) / -along.z();
    // z − h(x) changes along the line by at most its length times √(1 + (ak)²).
    const double steepest = std::sqrt(1 + kAmplitude * kAmplitude * kNumber * kNumber);
    const auto above = [&](double t) {
      return (from.z() + t * along.z() - height(from.x() + t * along.x())) / steepest;
    };
    const std::optional<double> distance = marchToZero(above, near, far + 1e-6);
    if (!distance) return std::nullopt;
    const double x = from.x() + *distance * along.x();
    const double slope = kAmplitude * kNumber * std::cos(kNumber * x);
    const double bend = -kAmplitude * kNumber * kNumber * std::sin(kNumber * x);
    const double length = std::sqrt(1 + slope * slope);
    // A crest, h'' < 0, is convex.
    return Hit{*distance, axes_.linear() * Eigen::Vector3d(-slope, 0, 1) / length, bend / (length * length * length)};
  }

  Eigen::Isometry3d axes() const override { return axes_; }

  Eigen::AlignedBox3d extent() const override {
    return levelExtent(kAmplitude + kShapeSpacing, 2 * kAmplitude + 4 * kShapeSpacing);
  }

 private:
  static constexpr double kAmplitude = 1.5 * kShapeSpacing;
  static constexpr double kNumber = 2 * std::numbers::pi / (20 * kShapeSpacing);

  static double height(double x) { return kAmplitude * std::sin(kNumber * x); }

  /// x of the point of the profile that is nearest to (px, pz), which is at most 1/(ak²), the least radius of
  /// curvature, away from where the profile bends towards it: Newton's method on the squared distance.
  static double nearestCrestwise(double px, double pz) {
    double x = px;
    for (int i = 0; i < 50; ++i) {
      const double slope = kAmplitude * kNumber * std::cos(kNumber * x);
      const double bend = -kAmplitude * kNumber * kNumber * std::sin(kNumber * x);
      const double first = (x - px) + (height(x) - pz) * slope;
      // Where the distance is not convex, far below a trough, a plain descent step.
      const double second = std::max(1 + slope * slope + (height(x) - pz) * bend, 0.5);
      const double step = first / second;
      x -= step;
      if (std::abs(step) < 1e-12) break;
    }
    return x;
  }

  Eigen::Isometry3d axes_ =
      levelAxes({0, 0, -4}, Eigen::Vector3d(0.25, std::sin(0.61), std::cos(0.61)).normalized());  // 0.61 is 35°
};

}  // namespace

std::unique_ptr<Shape> makeWave() { return std::make_unique<Wave>(); }

}  // namespace sluice::evaluate
