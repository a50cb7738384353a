#pragma once

#include <span>

#include "sluice/core/camera.h"

namespace sluice::render {

/// A surface of inverse depths, 1/m, row by row, in twice as many pixels a side. `fine` is the size of the outcome, and
/// `coarse` half of it, rounded up; both have the same middle, see divided(). Values in between are interpolated where
/// eye depths differ by at most `edge`, m; across a step the nearest is taken, and beyond a silhouette (0) the liquid
/// beside it. Runs on the OpenMP team of the calling thread.
void refineSurface(std::span<const float> coarse, core::ImageSize coarseSize, float edge, std::span<float> fine,
                   core::ImageSize fineSize);

}  // namespace sluice::render
