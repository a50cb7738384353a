#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sluice::evaluate {

struct PlotPoint {
  double x = 0;
  double y = 0;
  std::string title;       ///< Shown by viewers that point at it; may be empty.
  std::string label = {};  ///< Stands beside it where it is on the Pareto front and one is drawn.
};

/// Points of one kind, in the order in which a line joins them.
struct PlotSeries {
  std::string name;   ///< In the legend, once for each colour.
  std::string label;  ///< Stands beside its last point; empty for none.
  int colour = 0;     ///< Series of one kind share a number; it also sets the marker's shape.
  enum class Fill { Solid, Ring, Dot } fill = Fill::Solid;
  bool line = true;
  bool dashed = false;
  std::vector<PlotPoint> points;
};

/// A scatter plot with logarithmic axes.
struct ScatterPlot {
  std::string title;
  std::string subtitle;
  std::string xLabel;
  std::string yLabel;
  std::vector<PlotSeries> series;
  std::optional<double> level;  ///< A value of y that a dashed line marks.
  std::string levelLabel;
  bool paretoFront = false;          ///< Draw the front of the points that none other beats in both x and y.
  std::vector<std::string> fillKey;  ///< What Solid, Ring and Dot stand for, where it matters.
};

/// The points that no other is at most as large as in both coordinates and smaller in one, by rising x.
std::vector<PlotPoint> paretoFront(const std::vector<PlotPoint>& points);

/// An SVG picture that follows the reader's light or dark scheme. Points at or below 0 in either coordinate, which
/// logarithmic axes do not have, are left out.
std::string drawSvg(const ScatterPlot& plot);

}  // namespace sluice::evaluate
