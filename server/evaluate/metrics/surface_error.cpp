#include "metrics/surface_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "sluice/core/check.h"

namespace sluice::evaluate {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Between unit vectors; by the cross product too, as the cosine alone cannot tell angles below 0.03°.
double angleDegrees(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3d u = a.cast<double>();
  const Eigen::Vector3d v = b.cast<double>();
  return std::atan2(u.cross(v).norm(), u.dot(v)) * kDegrees;
}

// Of no values at all there is no mean: NaN, which reports leave empty.
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? kNone : sum / static_cast<double>(values.size());
}

double rootMeanSquare(const std::vector<double>& values, double about = 0) {
  double sum = 0;
  for (const double v : values) sum += (v - about) * (v - about);
  return values.empty() ? kNone : std::sqrt(sum / static_cast<double>(values.size()));
}

/// The value that `fraction` of all are below. Reorders.
double quantile(std::vector<double>& values, double fraction) {
  if (values.empty()) return kNone;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

Mask liquidOf(const std::vector<float>& q, core::ImageSize size) {
  Mask mask(size);
  std::ranges::transform(q, mask.set.begin(), [](float v) { return v > 0 ? std::uint8_t{1} : std::uint8_t{0}; });
  return mask;
}

/// The normal between four pixels, in view space; none unless all four are liquid near inverse depth `q`.
std::optional<Eigen::Vector3d> normalAt(const Eigen::Vector2d& pixel, double q, double edge,
                                        const std::vector<float>& picture, const SurfaceGeometry& geometry,
                                        const Sight& sight) {
  const auto x = static_cast<int>(std::floor(pixel.x()));
  const auto y = static_cast<int>(std::floor(pixel.y()));
  if (x < 0 || y < 0 || x + 1 >= sight.size.width || y + 1 >= sight.size.height) return std::nullopt;
  const double right = pixel.x() - x;
  const double down = pixel.y() - y;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const std::size_t at = sight.index(x + i, y + j);
      const double there = picture[at];
      if (!(there > 0) || std::abs(there - q) > edge * there * q) return std::nullopt;
      sum += (i == 1 ? right : 1 - right) * (j == 1 ? down : 1 - down) * geometry.normals[at].cast<double>();
    }
  }
  return sum.normalized();
}

}  // namespace

SurfaceError compareSurface(const std::vector<float>& q, const SurfaceGeometry& geometry, const Reference& reference) {
  const ReferencePicture& truth = reference.surface;
  SLUICE_CHECK_EQ(q.size(), truth.sight.pixels());
  SurfaceError error;
  std::vector<double> distances;
  std::vector<double> angles;
  std::vector<double> curvatures;
  std::size_t holes = 0;
  for (int y = 0; y < truth.sight.size.height; ++y) {
    for (int x = 0; x < truth.sight.size.width; ++x) {
      const std::size_t i = truth.sight.index(x, y);
      if (reference.interior.set[i] == 0) continue;
      if (!(q[i] > 0)) {
        ++holes;
        continue;
      }
      const double alongLine = (1 / static_cast<double>(q[i]) - truth.depths[i]) * truth.sight.line(x, y).norm();
      distances.push_back(alongLine * truth.cosines[i] / reference.spacing);
      angles.push_back(angleDegrees(geometry.normals[i], truth.normals[i]));
      const double bend = static_cast<double>(geometry.curvatures[i]) - static_cast<double>(truth.curvatures[i]);
      if (!std::isnan(bend)) curvatures.push_back(std::abs(bend) * reference.spacing);
    }
  }
  error.judgedPixels = distances.size();
  error.depthRmseSpacings = rootMeanSquare(distances);
  const double median = quantile(distances, 0.5);
  error.depthRmseUnbiasedSpacings = rootMeanSquare(distances, median);
  error.normalMeanDegrees = mean(angles);
  error.normalRmsDegrees = rootMeanSquare(angles);
  error.normalP95Degrees = quantile(angles, 0.95);
  error.curvatureResidual = mean(curvatures);

  const auto pixelsOfPicture = static_cast<std::size_t>(reference.divisor * reference.divisor);
  error.holes = holes * pixelsOfPicture;
  const Mask seen = enlarged(liquidOf(q, truth.sight.size), reference.divisor, reference.pictureLiquid.size);
  error.silhouetteIou = intersectionOverUnion(seen, reference.pictureLiquid);
  error.hausdorffPixels = hausdorffDistance(seen, reference.pictureLiquid);
  return error;
}

double flickerDegrees(const std::vector<float>& q, const SurfaceGeometry& geometry, const Reference& reference,
                      const std::vector<float>& turnedQ, const SurfaceGeometry& turnedGeometry,
                      const Sight& turnedSight) {
  const Sight& sight = reference.surface.sight;
  std::vector<double> angles;
  for (int y = 0; y < sight.size.height; ++y) {
    for (int x = 0; x < sight.size.width; ++x) {
      const std::size_t i = sight.index(x, y);
      if (reference.interior.set[i] == 0 || !(q[i] > 0)) continue;
      const Eigen::Vector3d world = sight.eye + sight.toWorld * sight.line(x, y) / static_cast<double>(q[i]);
      const Eigen::Vector3d there = turnedSight.toView(world);
      if (!(there.z() > 0)) continue;
      const auto normal =
          normalAt(turnedSight.toPixel(there), 1 / there.z(), reference.edge, turnedQ, turnedGeometry, turnedSight);
      if (!normal) continue;
      const Eigen::Vector3f before = (sight.toWorld * geometry.normals[i].cast<double>()).cast<float>();
      angles.push_back(angleDegrees(before, (turnedSight.toWorld * *normal).cast<float>()));
    }
  }
  return rootMeanSquare(angles);
}

}  // namespace sluice::evaluate
