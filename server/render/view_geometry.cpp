#include "view_geometry.h"

#include <cmath>
#include <numbers>

#include "sluice/render/frame_plan.h"

namespace sluice::render {

namespace {

Eigen::Vector2f slopeAtEdges(const ViewGeometry& view) {
  return 0.5F * view.pixelSlope *
         Eigen::Vector2f(static_cast<float>(view.size.width), static_cast<float>(view.size.height));
}

}  // namespace

ViewGeometry makeViewGeometry(const core::Camera& camera, core::ImageSize size) {
  const core::ViewBasis basis = core::viewBasis(camera);
  const float halfAngle = 0.5F * camera.verticalFovDegrees * std::numbers::pi_v<float> / 180.0F;
  ViewGeometry view;
  view.eye = camera.eye;
  view.right = basis.right;
  view.down = -basis.up;
  view.forward = basis.forward;
  view.size = size;
  view.pixelSlope = 2.0F * std::tan(halfAngle) / static_cast<float>(size.height);
  view.maxSlope = slopeAtEdges(view);
  return view;
}

ViewGeometry divided(const ViewGeometry& view, unsigned divisor) {
  ViewGeometry coarse = view;
  coarse.size = dividedSize(view.size, divisor);
  coarse.pixelSlope = view.pixelSlope * static_cast<float>(divisor);
  coarse.maxSlope = slopeAtEdges(coarse);
  return coarse;
}

SlopeBounds sphereBounds(const Eigen::Vector3f& centre, float radius) {
  const float squaredRadius = radius * radius;
  const float z = centre.z();
  const float scale = 1.0F / (z * z - squaredRadius);
  const Eigen::Vector2f inPlane = centre.head<2>();
  const Eigen::Vector2f root = (inPlane.array().square() + (z * z - squaredRadius)).sqrt();
  return {inPlane * (z * scale), root * (radius * scale)};
}

}  // namespace sluice::render
