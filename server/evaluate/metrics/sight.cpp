#include "metrics/sight.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace sluice::evaluate {

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

Sight makeSight(const core::Camera& camera, core::ImageSize size) {
  const core::ViewBasis basis = core::viewBasis(camera);
  Sight sight;
  sight.eye = camera.eye.cast<double>();
  sight.toWorld << basis.right.cast<double>(), -basis.up.cast<double>(), basis.forward.cast<double>();
  sight.pixelSlope = 2 * std::tan(0.5 * radians(camera.verticalFovDegrees)) / size.height;
  sight.size = size;
  return sight;
}

core::Camera turned(const core::Camera& camera, double degrees) {
  const Eigen::AngleAxisf turn(static_cast<float>(radians(degrees)), camera.up.normalized());
  core::Camera result = camera;
  result.eye = camera.target + turn * (camera.eye - camera.target);
  return result;
}

}  // namespace sluice::evaluate
