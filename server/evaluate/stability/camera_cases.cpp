#include "stability/camera_cases.h"

#include <cmath>

#include "shapes/shape.h"

namespace sluice::evaluate {

namespace {

constexpr core::ImageSize kSize{160, 120};

core::ParticleSnapshot cloud(std::vector<Eigen::Vector3f> positions, double spacing) {
  core::ParticleSnapshot particles;
  particles.spacing = spacing;
  particles.bounds = core::boundsOf(positions);
  particles.positions = std::move(positions);
  return particles;
}

/// The sphere of 10 d at (0.3, −0.2, −4).
core::ParticleSnapshot sphere() { return fillShape(*makeSphere(), 1); }

core::Camera at(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, float fovDegrees = 45.0F) {
  return {eye, target, {0, 1, 0}, fovDegrees};
}

/// How far a sphere of `spacing` must be for its splat to be `pixels` wide in kSize at 45°.
float distanceFor(double spacing, double pixels) {
  const double pixelSlope = 2 * 0.41421356 / kSize.height;  // 2·tan(22.5°)
  return static_cast<float>(2 * 0.9 * spacing / (pixels * pixelSlope));
}

}  // namespace

std::vector<CameraCase> cameraCases() {
  const core::ParticleSnapshot ball = sphere();
  const Eigen::Vector3f middle(0.3F, -0.2F, -4.0F);
  const Eigen::Vector3f particle = ball.positions.front();
  const Eigen::Vector3f z = Eigen::Vector3f::UnitZ();
  const float d = static_cast<float>(kShapeSpacing);

  std::vector<CameraCase> cases;
  cases.push_back({"in front", ball, shapeCamera(), kSize});
  cases.push_back({"inside a particle", ball, at(particle, particle - z), kSize});
  cases.push_back({"inside the liquid", ball, at(middle, middle - z), kSize});
  cases.push_back({"a hair before the surface", ball, at(middle + 1.001F * z, middle), kSize});
  cases.push_back({"almost at the near depth", cloud({-0.99F * d * z}, d), at({0, 0, 0}, -z), kSize});
  cases.push_back({"behind the camera", ball, at({0, 0, 0}, z), kSize});
  cases.push_back(
      {"beside the camera", cloud({{d, 0, 0}, {0, d, 0}, {0, 0, d}, {d, d, -d}}, d), at({0, 0, 0}, -z), kSize});
  cases.push_back({"eye on a target", ball, at(middle, middle), kSize});
  cases.push_back({"up along the line of sight", ball, {{0.3F, 3, -4}, middle, {0, 1, 0}, 45.0F}, kSize});
  cases.push_back({"field of view of 5 degrees", ball, at({0, 0, 6}, middle, 5.0F), kSize});
  cases.push_back({"field of view of 120 degrees", ball, at({0, 0, -1.5F}, middle, 120.0F), kSize});
  cases.push_back({"picture of 4 to 1", ball, shapeCamera(), {320, 80}});
  cases.push_back({"picture of 1 to 4", ball, shapeCamera(), {80, 320}});
  cases.push_back({"picture of one pixel", ball, shapeCamera(), {1, 1}});
  cases.push_back({"picture of one row", ball, at({0, 0, 0}, middle), {256, 1}});
  cases.push_back({"splats below a pixel", ball, at(middle + distanceFor(d, 0.3) * z, middle), kSize});
  cases.push_back({"splats of 500 pixels", cloud({{0, 0, -1}, {0.4F, 0, -1.2F}, {-0.4F, 0.2F, -0.9F}}, 0.5),
                   at({0, 0, distanceFor(0.5, 500) - 1}, {0, 0, -1}), kSize});
  cases.push_back({"a thousand kilometres away", ball, at({0, 0, 1e6F}, middle, 1.0F), kSize});
  cases.push_back(
      {"a million times as large", cloud({{0, 0, -4e6F}, {1e5F, 0, -4e6F}}, 1e5), at({0, 0, 0}, -z), kSize});
  cases.push_back(
      {"a millionth of the size", cloud({{0, 0, -4e-6F}, {1e-7F, 0, -4e-6F}}, 1e-7), at({0, 0, 0}, -1e-6F * z), kSize});
  cases.push_back(
      {"all particles in one place", cloud(std::vector<Eigen::Vector3f>(100, middle), d), shapeCamera(), kSize});
  return cases;
}

}  // namespace sluice::evaluate
