#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strip_bins.h"
#include "view_splats.h"

namespace sluice::render {

/// Draws splats into pictures of floats on the CPU: what splats.frag and thickness.frag draw, several times as fast as
/// a software GL does. In both pictures a splat is widened to what a pixel of the target needs, see visibleRadius.
///
/// The picture is cut into strips of rows, each of which one thread draws in the order of the splats, so that the
/// result is the same for any number of threads. Uses the OpenMP team of the calling thread.
class SplatRaster {
 public:
  /// q = max(q, 1/z of the front) wherever a splat is; `q` has the target's size, row by row. `rimDepth` is 0, or
  /// where, in radii before its centre, a splat's limb is cut to a flat rim: see rimOf in splat_rows.h.
  void drawDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, float rimDepth, std::span<float> q);
  void drawDepth(std::span<const ViewEllipsoid> ellipsoids, const ViewGeometry& target, float rimDepth,
                 std::span<float> q);
  /// The same for discs about the spheres' centres, parallel to the picture.
  void drawDiscDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, std::span<float> q);

  /// The farthest sides: z = the largest depth at which a line of sight leaves a splat, m, or 0 where there is none.
  void drawBackDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, float rimDepth,
                     std::span<float> z);
  void drawBackDepth(std::span<const ViewEllipsoid> ellipsoids, const ViewGeometry& target, float rimDepth,
                     std::span<float> z);
  void drawDiscBackDepth(std::span<const ViewSphere> spheres, const ViewGeometry& target, std::span<float> z);

  /// thickness += κ·(length of the line of sight inside) for every splat, where κ is a particle's volume, m³, over the
  /// splat's.
  void drawThickness(std::span<const ViewSphere> spheres, const ViewGeometry& target, float particleVolume,
                     std::span<float> thickness);
  void drawThickness(std::span<const ViewEllipsoid> ellipsoids, const ViewGeometry& target, float particleVolume,
                     std::span<float> thickness);

 private:
  template <class Splat>
  void bin(std::span<const Splat> splats, const ViewGeometry& target);
  template <class DrawStrip>
  void forEachStrip(const ViewGeometry& target, float empty, const DrawStrip& drawStrip);
  template <class Splat, class DrawRows, class FinishRow>
  void draw(std::span<const Splat> splats, const ViewGeometry& target, float empty, const DrawRows& drawRows,
            const FinishRow& finishRow);
  template <class Splat, class DrawRows>
  void drawBacks(std::span<const Splat> splats, const ViewGeometry& target, std::span<float> z,
                 const DrawRows& drawRows);
  template <class Splat, class DrawRows>
  void drawFronts(std::span<const Splat> splats, const ViewGeometry& target, std::span<float> q,
                  const DrawRows& drawRows);
  template <class Splat, class DrawRows>
  void drawChords(std::span<const Splat> splats, const ViewGeometry& target, std::span<float> thickness,
                  const DrawRows& drawRows);

  std::vector<PixelBounds> bounds_;
  StripBins bins_;
  std::vector<float> columnSlopes_;  ///< W_x of every column, padded by a block.
};

}  // namespace sluice::render
