#pragma once

#include <span>
#include <vector>

#include "strip_bins.h"
#include "view_geometry.h"

namespace sluice::render {

/// A particle with the value that it brings to the surface, in view space.
struct ViewValue {
  float x, y, z;  ///< m; z > 0.
  float value;
};

/// How far a particle's value reaches across the line of sight, in splat radii: to where the second ring of neighbours
/// stands, so that values change smoothly from one to the next.
inline constexpr float kValueReach = 2.0F;
/// And along it, before and behind the smoothed surface: farther, because smoothing may have moved that.
inline constexpr float kValueDepthReach = 3.0F;
/// Share of a value where no particle is within that reach of the surface: of all that are before and behind.
inline constexpr float kValueEverywhere = 1e-6F;

/// Least reach across the line of sight, in pixels: below, a particle falls between pixels.
inline constexpr float kValueLeastPixels = 1.5F;

/// Brings values of particles to the surface, on the CPU: what attributes.frag does on the device. At every pixel
/// Σ w·a / Σ w over the particles with
///   w = (1 − ρ²/h²)²·(ε + (1 − δ²/k²)²),
/// ρ a particle's distance from the line of sight, across the view axis at the particle's depth, and δ its eye depth
/// less the surface's: what stands before or behind in the picture, but not at the surface, does not show.
///
/// Strips of rows are drawn by one thread each in the order of the particles, so that the result is the same for any
/// number of threads. Uses the OpenMP team of the calling thread.
class AttributeRaster {
 public:
  /// `q`, inverse eye depths of the surface as `surfaceView` sees it, is read at the nearest pixel to those of
  /// `target`. `radius` is that of the splats, m. `result` has the target's size; it is 0 where no particle is near.
  void draw(std::span<const ViewValue> particles, float radius, std::span<const float> q,
            const ViewGeometry& surfaceView, const ViewGeometry& target, std::span<float> result);

 private:
  void bin(std::span<const ViewValue> particles, float reach, const ViewGeometry& target);
  void readDepths(std::span<const float> q, const ViewGeometry& surfaceView, const ViewGeometry& target);

  std::vector<float> columnSlopes_;  ///< W_x of every column, padded by a block.
  std::vector<float> depths_;        ///< Eye depth of the surface at every pixel, m; rows padded by a block.
  std::vector<PixelBounds> bounds_;
  StripBins bins_;
};

}  // namespace sluice::render
