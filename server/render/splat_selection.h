#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "view_geometry.h"

namespace sluice::render {

/// How particles are to be drawn, besides the camera.
struct SplatLimits {
  float radius = 0;            ///< R of every splat, m.
  float nearDepth = 0;         ///< Surfaces nearer than this are cut off here, m.
  float maxPointPixels = 0;    ///< Largest point that the device draws.
  bool leaveOutHidden = true;  ///< Off only to compare.
};

/// Which particles are drawn, by index, and how.
struct SplatSelection {
  /// Drawn as points: first those that may be seen, then, from `visiblePoints` on, those wholly behind others.
  std::vector<std::uint32_t> points;
  std::size_t visiblePoints = 0;
  /// Drawn as quads: too large for a point, or cut by the near depth.
  std::vector<std::uint32_t> large;
  /// Least eye depth of any drawn sphere, at least the near depth, m.
  float nearestDepth = 0;
};

/// Radius that still covers a pixel's centre when a sphere shrinks below a pixel; keeps far liquid free of holes.
/// 0.75 pixels: a little more than half a pixel's diagonal.
inline float visibleRadius(float radius, float depth, float pixelSlope) {
  return std::max(radius, 0.75F * pixelSlope * depth);
}

/// Leaves out what is outside the picture, and finds spheres that are wholly behind others.
///
/// Hidden spheres are found exactly, on the safe side: a sphere of centre c hides all that is farther from the eye than
/// √(|c|²−R²), where lines of sight touch it, in the tiles of the picture that lie inside its outline; and a sphere c'
/// is hidden when it is farther, |c'|−R, in every tile that its outline meets. Leaving those out cannot change a pixel.
SplatSelection selectSplats(std::span<const Eigen::Vector3f> positions, const ViewGeometry& view,
                            const SplatLimits& limits);

}  // namespace sluice::render
