#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "sluice/core/camera.h"

namespace sluice::evaluate {

/// The lines of sight of a picture. View space has x to the right, y down and z forwards, m; a line of sight is named
/// by its slope W = (x/z, y/z), and rows go from the top down, as in the renderer's buffers.
struct Sight {
  Eigen::Vector3d eye;
  Eigen::Matrix3d toWorld;  ///< Columns: right, down, forward.
  double pixelSlope = 0;    ///< C, the width of a pixel at depth 1.
  core::ImageSize size;

  std::size_t pixels() const { return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
  }

  /// Slope through a pixel's middle.
  Eigen::Vector2d slope(int x, int y) const {
    return {(x + 0.5 - 0.5 * size.width) * pixelSlope, (y + 0.5 - 0.5 * size.height) * pixelSlope};
  }

  /// (W_x, W_y, 1): the point of a pixel's line at depth 1, in view space.
  Eigen::Vector3d line(int x, int y) const {
    const Eigen::Vector2d w = slope(x, y);
    return {w.x(), w.y(), 1.0};
  }

  Eigen::Vector3d toView(const Eigen::Vector3d& world) const { return toWorld.transpose() * (world - eye); }

  /// Of a point in view space: pixel coordinates, whole numbers in the pixels' middles.
  Eigen::Vector2d toPixel(const Eigen::Vector3d& view) const {
    const Eigen::Vector2d w = view.head<2>() / view.z();
    return {w.x() / pixelSlope + 0.5 * size.width - 0.5, w.y() / pixelSlope + 0.5 * size.height - 0.5};
  }
};

Sight makeSight(const core::Camera& camera, core::ImageSize size);

/// The camera turned about its target around the vertical.
core::Camera turned(const core::Camera& camera, double degrees);

}  // namespace sluice::evaluate
