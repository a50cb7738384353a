#pragma once

#include <span>
#include <vector>

#include "noise_rows.h"
#include "noise_sprites.h"
#include "strip_bins.h"
#include "view_geometry.h"

namespace sluice::render {

/// Draws noise on the CPU: what noise.frag sums and finish_noise.frag finishes. Strips of rows as in SplatRaster, and
/// so the same result for any number of threads. Uses the OpenMP team of the calling thread.
class NoiseRaster {
 public:
  /// `surface` is the inverse eye depth of the target's pixels, 0 without liquid. Fills `height`, m, and, unless that
  /// is empty, `violence`, 0 to 1; both are 0 where there is no liquid.
  void draw(std::span<const NoiseSprite> sprites, const ViewGeometry& target, float fallOff,
            std::span<const float> surface, std::span<float> height, std::span<float> violence);

 private:
  std::vector<PixelBounds> bounds_;
  StripBins bins_;
  std::vector<float> columnSlopes_;  ///< W_x of every column, padded by a block.
};

}  // namespace sluice::render
