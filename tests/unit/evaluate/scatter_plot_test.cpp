#include "scatter_plot.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logarithmic_axis.h"

namespace sluice::evaluate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(ScatterPlot, FrontHoldsWhatNothingBeats) {
  const std::vector<PlotPoint> front =
      paretoFront({{3, 1, "c"}, {1, 5, "a"}, {2, 5, "beaten"}, {2, 2, "b"}, {4, 1, "beaten"}, {1, 6, "beaten"}});
  std::vector<std::string> names;
  for (const PlotPoint& p : front) names.push_back(p.title);
  EXPECT_THAT(names, ElementsAre("a", "b", "c"));
}

TEST(ScatterPlot, TicksAreRoundAndWithin) {
  EXPECT_THAT(logarithmicTicks(0.9, 25), ElementsAre(1, 2, 5, 10, 20));
  EXPECT_THAT(logarithmicTicks(0.5, 5e4), ElementsAre(1, 10, 100, 1000, 10000));
  EXPECT_THAT(logarithmicTicks(0.9, 2.1), ElementsAre(1, 1.5, 2));
}

TEST(ScatterPlot, TicksAreWrittenForPeople) {
  EXPECT_EQ(tickText(0.05), "0.05");
  EXPECT_EQ(tickText(20000), "20 k");
  EXPECT_EQ(tickText(2e6), "2 M");
  EXPECT_EQ(tickText(1e-8), "10⁻⁸");
  EXPECT_EQ(tickText(5e-12), "5·10⁻¹²");
}

TEST(ScatterPlot, LabelsTheFrontAlone) {
  ScatterPlot plot;
  plot.paretoFront = true;
  PlotSeries series;
  series.points = {{1, 5, {}, "fast"}, {3, 1, {}, "close"}, {10, 10, {}, "beaten"}};
  plot.series = {series};
  const std::string svg = drawSvg(plot);
  EXPECT_THAT(svg, HasSubstr(">fast<"));
  EXPECT_THAT(svg, HasSubstr(">close<"));
  EXPECT_THAT(svg, Not(HasSubstr("beaten")));
}

TEST(ScatterPlot, DrawsEveryPointThatTheAxesHave) {
  ScatterPlot plot;
  plot.title = "a < b & c";
  PlotSeries series;
  series.name = "one";
  series.points = {{1, 1, {}}, {10, 2, {}}, {0, 3, {}}, {5, -1, {}}};
  series.line = false;
  plot.series = {series};
  const std::string svg = drawSvg(plot);
  EXPECT_EQ(count(svg, "<circle"), 3U) << "two points and the legend's";
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, HasSubstr("prefers-color-scheme:dark"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(ScatterPlot, HasAxesWithoutPoints) {
  const std::string svg = drawSvg({});
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(ScatterPlot, KindsDifferInColourOrShape) {
  std::vector<std::string> markers;
  for (int kind = 0; kind < 40; ++kind) {
    ScatterPlot plot;
    PlotSeries series;
    series.colour = kind;
    series.line = false;
    series.points = {{1, 1, {}}};
    plot.series = {series};
    markers.push_back(drawSvg(plot));
  }
  std::ranges::sort(markers);
  EXPECT_EQ(std::ranges::adjacent_find(markers), markers.end());
}

}  // namespace
}  // namespace sluice::evaluate
