#include "scatter_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "logarithmic_axis.h"
#include "plot_marks.h"

namespace sluice::evaluate {

namespace {

// Of the picture and of the field inside its axes, in SVG's pixels.
constexpr double kWidth = 900;
constexpr double kHeight = 560;
constexpr double kLeft = 84;
constexpr double kTop = 78;
constexpr double kRight = 640;  // the legend stands beside it
constexpr double kBottom = 492;

constexpr const char* kStyle = R"(<style>
text{font-family:system-ui,-apple-system,"Segoe UI",Helvetica,Arial,sans-serif;font-size:12px;fill:#24292f}
.title{font-size:17px;font-weight:600}.quiet{fill:#57606a}.label{font-size:11px;font-weight:600;stroke:#ffffff;stroke-width:3px;paint-order:stroke}
.paper{fill:#ffffff}.grid{stroke:#d8dee4;stroke-width:1}.frame{stroke:#8c959f;stroke-width:1;fill:none}
.front{stroke:#24292f;stroke-width:7;stroke-opacity:.13;fill:none;stroke-linejoin:round;stroke-linecap:round}
.level{stroke:#57606a;stroke-width:1;stroke-dasharray:3 4;fill:none}.hollow{fill:#ffffff}
@media (prefers-color-scheme:dark){text{fill:#e6edf3}.quiet{fill:#9aa4af}.label{stroke:#0d1117}.paper{fill:#0d1117}.grid{stroke:#272d35}
.frame{stroke:#6e7681}.front{stroke:#e6edf3;stroke-opacity:.2}.level{stroke:#9aa4af}.hollow{fill:#0d1117}}
</style>
)";

bool isDrawn(const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y > 0; }

/// From data to the picture's pixels.
struct Axes {
  LogarithmicRange x;
  LogarithmicRange y;

  double atX(double value) const { return kLeft + (kRight - kLeft) * x.share(value); }
  double atY(double value) const { return kBottom - (kBottom - kTop) * y.share(value); }
};

struct Box {
  double left;
  double top;
  double right;
  double bottom;

  bool overlaps(const Box& o) const { return left < o.right && o.left < right && top < o.bottom && o.top < bottom; }
};

class Drawing {
 public:
  explicit Drawing(const ScatterPlot& plot) : plot_(plot) {
    out_.precision(5);
    LogarithmicRange x;
    LogarithmicRange y;
    for (const PlotSeries& series : plot.series) {
      for (const PlotPoint& point : series.points) {
        if (!isDrawn(point)) continue;
        x.add(point.x);
        y.add(point.y);
      }
    }
    if (plot.level && *plot.level > 0) y.add(*plot.level);
    axes_ = {x.padded(), y.padded()};
  }

  std::string draw() {
    out_ << R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )" << kWidth << ' ' << kHeight << "\" width=\""
         << kWidth << "\" height=\"" << kHeight << "\" role=\"img\">\n<title>" << escaped(plot_.title) << "</title>\n"
         << kStyle << "<rect class=\"paper\" width=\"" << kWidth << "\" height=\"" << kHeight << "\" rx=\"8\"/>\n";
    text(kLeft, 32, plot_.title, "title");
    text(kLeft, 54, plot_.subtitle, "quiet");
    drawAxes();
    drawLevel();
    drawFront();
    for (const PlotSeries& series : plot_.series) drawLine(series);
    for (const PlotSeries& series : plot_.series) drawMarkers(series);
    drawLabels();
    drawLegend();
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  void text(double x, double y, const std::string& content, const char* style, const char* anchor = "start",
            const std::string& extra = "") {
    out_ << "<text x=\"" << x << "\" y=\"" << y << "\" class=\"" << style << "\" text-anchor=\"" << anchor << '"'
         << extra << '>' << escaped(content) << "</text>\n";
  }

  void drawAxes() {
    for (const double tick : logarithmicTicks(axes_.x.low, axes_.x.high)) {
      const double x = axes_.atX(tick);
      out_ << "<line class=\"grid\" x1=\"" << x << "\" x2=\"" << x << "\" y1=\"" << kTop << "\" y2=\"" << kBottom
           << "\"/>\n";
      text(x, kBottom + 18, tickText(tick), "quiet", "middle");
    }
    for (const double tick : logarithmicTicks(axes_.y.low, axes_.y.high)) {
      const double y = axes_.atY(tick);
      out_ << "<line class=\"grid\" x1=\"" << kLeft << "\" x2=\"" << kRight << "\" y1=\"" << y << "\" y2=\"" << y
           << "\"/>\n";
      text(kLeft - 8, y + 4, tickText(tick), "quiet", "end");
    }
    out_ << "<rect class=\"frame\" x=\"" << kLeft << "\" y=\"" << kTop << "\" width=\"" << kRight - kLeft
         << "\" height=\"" << kBottom - kTop << "\"/>\n";
    text(0.5 * (kLeft + kRight), kBottom + 44, plot_.xLabel, "axis", "middle");
    std::ostringstream turn;
    turn << " transform=\"rotate(-90 18 " << 0.5 * (kTop + kBottom) << ")\"";
    text(18, 0.5 * (kTop + kBottom), plot_.yLabel, "axis", "middle", turn.str());
  }

  void drawLevel() {
    if (!plot_.level || !(*plot_.level > 0)) return;
    const double y = axes_.atY(*plot_.level);
    out_ << "<line class=\"level\" x1=\"" << kLeft << "\" x2=\"" << kRight << "\" y1=\"" << y << "\" y2=\"" << y
         << "\"/>\n";
    const double width = 6.0 * static_cast<double>(plot_.levelLabel.size());
    text(kRight - 6, y - 5, plot_.levelLabel, "quiet", "end");
    taken_.push_back({kRight - 6 - width, y - 16, kRight - 6, y});
  }

  void drawFront() {
    if (!plot_.paretoFront) return;
    std::vector<PlotPoint> all;
    for (const PlotSeries& series : plot_.series) {
      std::ranges::copy_if(series.points, std::back_inserter(all), isDrawn);
    }
    front_ = paretoFront(all);
    if (front_.size() < 2) return;
    out_ << "<polyline class=\"front\" points=\"";
    for (const PlotPoint& p : front_) out_ << axes_.atX(p.x) << ',' << axes_.atY(p.y) << ' ';
    out_ << "\"/>\n";
  }

  void drawLine(const PlotSeries& series) {
    if (!series.line) return;
    out_ << "<polyline fill=\"none\" stroke=\"" << colourOf(series) << "\" stroke-opacity=\".75\" stroke-width=\"1.4\"";
    if (series.dashed) out_ << " stroke-dasharray=\"6 4\"";
    out_ << " points=\"";
    for (const PlotPoint& p : series.points) {
      if (isDrawn(p)) out_ << axes_.atX(p.x) << ',' << axes_.atY(p.y) << ' ';
    }
    out_ << "\"/>\n";
  }

  void drawMarkers(const PlotSeries& series) {
    if (series.dashed) return;  // a fit, whose points stand for a line
    for (const PlotPoint& p : series.points) {
      if (!isDrawn(p)) continue;
      const double x = axes_.atX(p.x);
      const double y = axes_.atY(p.y);
      drawMarker(out_, x, y, series, p.title);
      taken_.push_back({x - 5, y - 5, x + 5, y + 5});
    }
  }

  /// Beside each series' last point and the points of the front, where they cover nothing.
  void drawLabels() {
    for (const PlotPoint& p : front_) label(p, p.label);
    for (const PlotSeries& series : plot_.series) {
      const auto last = std::find_if(series.points.rbegin(), series.points.rend(), isDrawn);
      if (last != series.points.rend()) label(*last, series.label);
    }
  }

  /// Left out where there is no place for it.
  void label(const PlotPoint& p, const std::string& content) {
    if (content.empty()) return;
    const double x = axes_.atX(p.x);
    const double y = axes_.atY(p.y);
    const double width = 6.2 * static_cast<double>(content.size());  // of a letter at 11 px, on average
    constexpr double kHalfHeight = 7;
    struct Place {
      double dx;
      double dy;
      const char* anchor;
    };
    constexpr std::array<Place, 8> kPlaces{{{9, 0, "start"},
                                            {-9, 0, "end"},
                                            {0, -13, "middle"},
                                            {0, 14, "middle"},
                                            {8, -12, "start"},
                                            {8, 13, "start"},
                                            {-8, -12, "end"},
                                            {-8, 13, "end"}}};
    for (const Place& place : kPlaces) {
      const double shift = place.anchor[0] == 's' ? 0 : place.anchor[0] == 'e' ? -width : -0.5 * width;
      const double left = x + place.dx + shift;
      const Box box{left, y + place.dy - kHalfHeight, left + width, y + place.dy + kHalfHeight};
      const bool inside = box.left > kLeft && box.right < kRight && box.top > kTop && box.bottom < kBottom;
      if (!inside || std::ranges::any_of(taken_, [&](const Box& other) { return box.overlaps(other); })) continue;
      taken_.push_back(box);
      text(x + place.dx, y + place.dy + 4, content, "label", place.anchor);
      return;
    }
  }

  void drawLegend() {
    double y = kTop + 10;
    const double x = kRight + 22;
    std::vector<int> seen;
    for (const PlotSeries& series : plot_.series) {
      if (series.name.empty() || std::ranges::find(seen, series.colour) != seen.end()) continue;
      seen.push_back(series.colour);
      PlotSeries key = series;
      key.fill = PlotSeries::Fill::Solid;
      if (series.dashed) {
        out_ << "<line x1=\"" << x - 8 << "\" x2=\"" << x + 8 << "\" y1=\"" << y << "\" y2=\"" << y << "\" stroke=\""
             << colourOf(series) << "\" stroke-width=\"1.6\" stroke-dasharray=\"6 4\"/>\n";
      } else {
        drawMarker(out_, x, y, key, "");
      }
      text(x + 14, y + 4, series.name, "key");
      y += 20;
    }
    if (plot_.paretoFront) {
      y += 6;
      out_ << "<line class=\"front\" x1=\"" << x - 7 << "\" x2=\"" << x + 7 << "\" y1=\"" << y << "\" y2=\"" << y
           << "\"/>\n";
      text(x + 14, y + 4, "Pareto front", "key");
      y += 20;
    }
    if (!plot_.fillKey.empty()) y += 6;
    constexpr std::array kFills{PlotSeries::Fill::Solid, PlotSeries::Fill::Ring, PlotSeries::Fill::Dot};
    for (std::size_t i = 0; i < std::min(plot_.fillKey.size(), kFills.size()); ++i) {
      PlotSeries key;
      key.colour = 15;  // a grey circle: 15 is the first of five shapes and the last of eight colours
      key.fill = kFills[i];
      drawMarker(out_, x, y, key, "");
      text(x + 14, y + 4, plot_.fillKey[i], "key");
      y += 20;
    }
  }

  const ScatterPlot& plot_;
  Axes axes_;
  std::ostringstream out_;
  std::vector<PlotPoint> front_;
  std::vector<Box> taken_;  ///< Where labels would cover something.
};

}  // namespace

std::vector<PlotPoint> paretoFront(const std::vector<PlotPoint>& points) {
  std::vector<PlotPoint> sorted = points;
  std::ranges::sort(sorted, [](const PlotPoint& a, const PlotPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<PlotPoint> front;
  for (const PlotPoint& p : sorted) {
    if (front.empty() || p.y < front.back().y) front.push_back(p);
  }
  return front;
}

std::string drawSvg(const ScatterPlot& plot) { return Drawing(plot).draw(); }

}  // namespace sluice::evaluate
