#include "shapes/shape.h"

#include <cmath>
#include <numbers>
#include <random>

namespace sluice::evaluate {

std::vector<std::unique_ptr<Shape>> makeShapes() {
  std::vector<std::unique_ptr<Shape>> shapes;
  shapes.push_back(makeTiltedPlane());
  shapes.push_back(makeSphere());
  shapes.push_back(makeTorus());
  shapes.push_back(makeFacingPlane());
  shapes.push_back(makeCylinder());
  shapes.push_back(makeWave());
  shapes.push_back(makeTwoSpheres());
  return shapes;
}

core::Camera shapeCamera() { return {{0, 0, 0}, {0, 0, -4}, {0, 1, 0}, 45.0F}; }

namespace {

/// Whether a particle may show in the pictures of `shapeCamera`.
bool isInView(const Eigen::Vector3d& point) {
  const double half = std::tan(0.5 * shapeCamera().verticalFovDegrees * std::numbers::pi / 180);
  const double margin = 3 * kShapeSpacing;  // a splat, and what the camera turns
  return point.head<2>().cwiseAbs().maxCoeff() <= half * -point.z() + margin;
}

}  // namespace

core::ParticleSnapshot fillShape(const Shape& shape, std::uint64_t seed) {
  constexpr double d = kShapeSpacing;
  constexpr double kJitter = 0.25 * d;
  std::mt19937_64 random(seed);
  // Not std::uniform_real_distribution, whose values differ between libraries. 53 bits fill a double's mantissa.
  const auto jitter = [&] { return kJitter * (static_cast<double>(random() >> 11U) * 0x1p-52 - 1); };

  core::ParticleSnapshot particles;
  particles.spacing = d;
  const Eigen::Isometry3d axes = shape.axes();
  const Eigen::AlignedBox3d extent = shape.extent();
  const Eigen::Vector3i sites = (extent.sizes() / d).array().round().cast<int>();
  // From the upper end of z down, so that the first layer of a plane, whose extent ends at it, is half a spacing deep.
  for (int k = 0; k < sites.z(); ++k) {
    for (int j = 0; j < sites.y(); ++j) {
      for (int i = 0; i < sites.x(); ++i) {
        // One statement each: the order of the random numbers is part of the shape.
        const double x = extent.min().x() + (i + 0.5) * d + jitter();
        const double y = extent.min().y() + (j + 0.5) * d + jitter();
        const double z = extent.max().z() - (k + 0.5) * d + jitter();
        const Eigen::Vector3d point = axes * Eigen::Vector3d(x, y, z);
        if (isInView(point) && shape.depthBelow(point) > kJitter) particles.positions.push_back(point.cast<float>());
      }
    }
  }
  particles.bounds = core::boundsOf(particles.positions);
  return particles;
}

}  // namespace sluice::evaluate
