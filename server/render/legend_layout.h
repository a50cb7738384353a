#pragma once

#include <cstddef>
#include <vector>

#include "legend.h"
#include "sluice/core/frame.h"
#include "strip_bins.h"

namespace sluice::render {

/// Where a legend's panels stand in a picture, pixels: one above the other in the lower right corner.
struct LegendLayout {
  int em = 0;       ///< Size of the text: 2 % of the picture's height, where its width allows, and at least 10.
  int padding = 0;  ///< Between a panel's edge and what is in it.
  std::vector<PixelBounds> panels;  ///< From the top down.
};

/// As many as `legend` has entries. They all lie in a picture that is large enough, see legendFits().
LegendLayout layOut(const LegendEntries& legend, core::ImageSize size);

/// Whether a picture holds so many bars, or a ball, without giving up most of itself.
bool legendFits(core::ImageSize size, std::size_t entries);

}  // namespace sluice::render
