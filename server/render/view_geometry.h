#pragma once

#include <Eigen/Core>

#include "sluice/core/camera.h"

namespace sluice::render {

/// A camera and a picture size as the passes need them.
///
/// View space has x to the right, y *down* and z forwards, m, so that the first row of every texture is the top row of
/// the picture and reading back needs no flip. A line of sight is named by its slope W = (x/z, y/z); a pixel is as wide
/// as it is high, `pixelSlope` at depth 1.
struct ViewGeometry {
  Eigen::Vector3f eye;
  Eigen::Vector3f right;
  Eigen::Vector3f down;
  Eigen::Vector3f forward;
  Eigen::Vector2f maxSlope;  ///< |W_x| and |W_y| at the picture's edges.
  float pixelSlope = 0;      ///< C.
  core::ImageSize size;

  Eigen::Vector3f toView(const Eigen::Vector3f& world) const {
    const Eigen::Vector3f p = world - eye;
    return {p.dot(right), p.dot(down), p.dot(forward)};
  }

  /// Pixel coordinates from the top left corner, centres at half numbers.
  Eigen::Vector2f toPixel(const Eigen::Vector2f& slope) const {
    return slope / pixelSlope + 0.5F * Eigen::Vector2f(static_cast<float>(size.width), static_cast<float>(size.height));
  }
};

ViewGeometry makeViewGeometry(const core::Camera& camera, core::ImageSize size);

/// The same view on a coarser picture of square pixels, `divisor` times as wide, about the same middle. It reaches a
/// little beyond the picture where the size is not a multiple.
ViewGeometry divided(const ViewGeometry& view, unsigned divisor);

/// Bounds of a sphere's outline, in view slopes: the rectangle centre ± halfExtent.
struct SlopeBounds {
  Eigen::Vector2f centre;
  Eigen::Vector2f halfExtent;
};

/// For a sphere wholly in front of the eye (z > radius): W± = (x·z ± R·√(x²+z²−R²)) / (z²−R²), and likewise in y.
SlopeBounds sphereBounds(const Eigen::Vector3f& centre, float radius);

}  // namespace sluice::render
