#pragma once

#include <ostream>
#include <string>

#include "scatter_plot.h"

namespace sluice::evaluate {

/// Text with what XML reserves written as entities.
std::string escaped(const std::string& text);

/// A series' colour, as SVG writes it.
const char* colourOf(const PlotSeries& series);

/// Draws a marker about (x, y), in SVG's pixels, with a title for viewers that point at it, which may be empty. Circle,
/// square, triangle, diamond, triangle on its head by the colour's number: 40 kinds before one repeats.
void drawMarker(std::ostream& out, double x, double y, const PlotSeries& series, const std::string& title);

}  // namespace sluice::evaluate
