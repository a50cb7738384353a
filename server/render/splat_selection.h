#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "splat_model.h"
#include "view_geometry.h"
#include "view_splats.h"

namespace sluice::render {

/// How particles are to be drawn, besides the camera.
struct SplatLimits {
  float radius = 0;            ///< R of every splat that has none of its own, m.
  float dropRadius = 0;        ///< Of a drop of spray, m.
  float nearDepth = 0;         ///< Surfaces nearer than this are cut off here, m.
  float maxPointPixels = 0;    ///< Largest point that the device draws.
  bool leaveOutHidden = true;  ///< Off only to compare.
};

/// Particles by index, in rising order, with their splats.
struct SplatList {
  std::vector<std::uint32_t> particles;
  std::vector<ViewSphere> spheres;        ///< Around the ellipsoids where those are the shape.
  std::vector<ViewEllipsoid> ellipsoids;  ///< Empty for other shapes.

  std::size_t size() const { return particles.size(); }
};

/// Which particles are drawn, and how.
struct SplatSelection {
  /// Drawn as points, all of which count for thickness: the order of a sum of floats does not depend on what is hidden.
  SplatList points;
  /// Those of them that may be seen: neither wholly behind others, nor interior.
  SplatList visible;
  std::size_t interiorPoints = 0;  ///< How many of the others are interior.
  /// Drawn as quads: too large for a point, or cut by the near depth.
  std::vector<std::uint32_t> large;
  /// Drops in the picture, none nearer than the near depth.
  std::vector<std::uint32_t> spray;
  /// Least eye depth of any drawn sphere, at least the near depth, m.
  float nearestDepth = 0;
};

/// Leaves out what is outside the picture, and finds spheres that are wholly behind others.
///
/// Hidden spheres are found exactly, on the safe side: a sphere of centre c hides all that is farther from the eye than
/// √(|c|²−R²), where lines of sight touch it, in the tiles of the picture that lie inside its outline; and a sphere c'
/// is hidden when it is farther, |c'|−R, in every tile that its outline meets. Leaving those out cannot change a pixel.
/// An ellipsoid hides what the largest ball inside it does, and is hidden with the least ball around it; a disc hides
/// what is farther than all of it, |c|+R.
///
/// Uses the OpenMP team of the calling thread; the result is the same for any number of threads.
SplatSelection selectSplats(std::span<const Eigen::Vector3f> positions, const SplatModel& model,
                            const ViewGeometry& view, const SplatLimits& limits);

}  // namespace sluice::render
