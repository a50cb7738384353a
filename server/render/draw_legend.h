#pragma once

#include <cstdint>
#include <span>

#include "legend.h"
#include "sluice/core/frame.h"
#include "typeface.h"

namespace sluice::render {

/// Draws a legend over a picture: 8-bit sRGB, RGBA, row by row from the top. Nothing outside its panels changes, and
/// the same arguments give the same pixels. Panels that the picture does not hold are cut off: see legendFits().
void drawLegend(std::span<std::uint8_t> pixels, core::ImageSize size, const LegendEntries& legend, Typeface& typeface);

}  // namespace sluice::render
