#include "plot_marks.h"

#include <array>
#include <initializer_list>
#include <sstream>
#include <utility>

namespace sluice::evaluate {

namespace {

/// Okabe & Ito 2008, which people with any of the usual colour deficiencies tell apart; their yellow and black, which
/// a light and a dark page swallow, replaced by grey and purple.
constexpr std::array<const char*, 8> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#8a63d2", "#8c8c8c"};

void polygon(std::ostringstream& out, std::initializer_list<std::pair<double, double>> corners) {
  out.precision(5);
  out << "<polygon points=\"";
  for (const auto& [x, y] : corners) out << x << ',' << y << ' ';
  out << '"';
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

const char* colourOf(const PlotSeries& series) {
  return kColours[static_cast<std::size_t>(series.colour) % kColours.size()];
}

void drawMarker(std::ostream& out, double x, double y, const PlotSeries& series, const std::string& title) {
  const double r = series.fill == PlotSeries::Fill::Dot ? 2.6 : 4.6;
  std::ostringstream shape;
  switch (series.colour % 5) {
    case 0:
      shape << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"" << r << '"';
      break;
    case 1:
      shape << "<rect x=\"" << x - 0.9 * r << "\" y=\"" << y - 0.9 * r << "\" width=\"" << 1.8 * r << "\" height=\""
            << 1.8 * r << '"';
      break;
    case 2:
      polygon(shape, {{x, y - 1.15 * r}, {x + 1.1 * r, y + 0.8 * r}, {x - 1.1 * r, y + 0.8 * r}});
      break;
    case 3:
      polygon(shape, {{x, y - 1.25 * r}, {x + 1.25 * r, y}, {x, y + 1.25 * r}, {x - 1.25 * r, y}});
      break;
    default:
      polygon(shape, {{x, y + 1.15 * r}, {x + 1.1 * r, y - 0.8 * r}, {x - 1.1 * r, y - 0.8 * r}});
      break;
  }
  const char* const colour = colourOf(series);
  out << shape.str() << " stroke=\"" << colour << "\" stroke-width=\"1.6\"";
  if (series.fill == PlotSeries::Fill::Ring) {
    out << " class=\"hollow\"";
  } else {
    out << " fill=\"" << colour << '"';
  }
  if (title.empty()) {
    out << "/>\n";
  } else {
    out << "><title>" << escaped(title) << "</title></"
        << (series.colour % 5 == 0   ? "circle"
            : series.colour % 5 == 1 ? "rect"
                                     : "polygon")
        << ">\n";
  }
}

}  // namespace sluice::evaluate
