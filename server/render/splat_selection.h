#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "splat_model.h"
#include "splat_raster.h"
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
  /// Drawn as points: first those that may be seen, then, from `visiblePoints` on, those that only count for thickness:
  /// wholly behind others, or interior.
  std::vector<std::uint32_t> points;
  /// The spheres of `points`, in the same order.
  std::vector<ViewSphere> spheres;
  std::size_t visiblePoints = 0;
  std::size_t interiorPoints = 0;  ///< How many of the rest are there for being interior.
  /// Drawn as quads: too large for a point, or cut by the near depth.
  std::vector<std::uint32_t> large;
  /// Drops in the picture.
  std::vector<std::uint32_t> spray;
  /// Least eye depth of any drawn sphere, at least the near depth, m.
  float nearestDepth = 0;
};

/// Leaves out what is outside the picture, and finds spheres that are wholly behind others.
///
/// Hidden spheres are found exactly, on the safe side: a sphere of centre c hides all that is farther from the eye than
/// √(|c|²−R²), where lines of sight touch it, in the tiles of the picture that lie inside its outline; and a sphere c'
/// is hidden when it is farther, |c'|−R, in every tile that its outline meets. Leaving those out cannot change a pixel.
///
/// Uses the OpenMP team of the calling thread; the result is the same for any number of threads.
SplatSelection selectSplats(std::span<const Eigen::Vector3f> positions, const SplatModel& model,
                            const ViewGeometry& view, const SplatLimits& limits);

}  // namespace sluice::render
