// Legends: ticks and their text, where the panels stand, and what is drawn.
#include "legend.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "draw_legend.h"
#include "legend_layout.h"
#include "sluice/scene/scene.h"
#include "study_pass.h"

namespace sluice::render {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

TEST(Ticks, AreRoundAndFew) {
  EXPECT_THAT(ticksOf({0, 1}).values, ElementsAre(0, 0.5, 1));
  EXPECT_THAT(ticksOf({0, 3}).values, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(ticksOf({-0.4F, 0.4F}).values, ElementsAre(DoubleNear(-0.4, 1e-9), DoubleNear(-0.2, 1e-9), 0,
                                                         DoubleNear(0.2, 1e-9), DoubleNear(0.4, 1e-9)));
  // By fives there are but 5 and 10.
  EXPECT_THAT(ticksOf({2, 12}).values, ElementsAre(2, 4, 6, 8, 10, 12));
}

TEST(Ticks, LieInAnyRangeAtStepsOf1Or2Or5) {
  int ideal = 0;
  int all = 0;
  for (float least = -7.3F; least < 5; least += 0.77F) {
    for (float width = 0.013F; width < 1e7F; width *= 1.37F) {
      const ValueRange range{least * width, least * width + width};
      const Ticks ticks = ticksOf(range);
      ASSERT_GE(ticks.values.size(), 3U) << range.least << " to " << range.most;
      ASSERT_LE(ticks.values.size(), 7U) << range.least << " to " << range.most;
      EXPECT_DOUBLE_EQ(niceStep(ticks.step), ticks.step);
      for (const double value : ticks.values) {
        const double slack = 1e-3 * static_cast<double>(width);
        EXPECT_GE(value, static_cast<double>(range.least) - slack);
        EXPECT_LE(value, static_cast<double>(range.most) + slack);
        EXPECT_NEAR(value / ticks.step, std::round(value / ticks.step), 1e-6);
      }
      if (ticks.values.size() <= 5) ++ideal;
      ++all;
    }
  }
  EXPECT_GT(ideal, 0.9 * all);
}

TEST(TickLabel, HasAsManyDecimalsAsItsStep) {
  EXPECT_EQ(tickLabel(0.002, 0.002), "0.002");
  EXPECT_EQ(tickLabel(0.5, 0.1), "0.5");
  EXPECT_EQ(tickLabel(1, 0.5), "1.0");
  EXPECT_EQ(tickLabel(-20, 10), "−20");
  EXPECT_EQ(tickLabel(5000, 1000), "5000");
  EXPECT_EQ(tickLabel(0, 0.001), "0.000");
}

TEST(ReadableUnit, MakesNumbersShort) {
  const auto unit = [](const char* name, float most) {
    const ColourBar bar = withReadableUnit({"", name, {0, most}, {}});
    return std::pair(bar.range.most, bar.unit);
  };
  EXPECT_EQ(unit("m", 0.3F), (std::pair(0.3F, std::string("m"))));
  EXPECT_EQ(unit("m", 0.004F).second, "mm");
  EXPECT_NEAR(unit("m", 0.004F).first, 4, 1e-4F);
  EXPECT_EQ(unit("Pa", 9000).second, "Pa");
  EXPECT_EQ(unit("Pa", 20000).second, "kPa");
  EXPECT_EQ(unit("Pa", 250000).second, "kPa");
  EXPECT_EQ(unit("", 20000).second, "");
  EXPECT_NEAR(unit("Pa", 250000).first, 250, 1e-2F);
  EXPECT_EQ(unit("m/s", 0.005F).second, "mm/s");
  EXPECT_EQ(unit("%", 0.005F).second, "10⁻³ %");
  EXPECT_EQ(unit("1/m", 300000).second, "10³/m");
  EXPECT_EQ(unit("", 2e6F).second, "10⁶");
  EXPECT_EQ(unit("m", 0).second, "m");
}

class LegendPicture : public ::testing::TestWithParam<core::ImageSize> {
 protected:
  static ColourBar bar() {
    ColourBar bar{"Speed", "m/s", {0, 3}, {}};
    for (int i = 0; i < 256; ++i) bar.colours.push_back({static_cast<std::uint8_t>(i), 40, 90});
    return bar;
  }

  static std::vector<std::uint8_t> plain(core::ImageSize size, std::uint8_t grey) {
    return std::vector<std::uint8_t>(4 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height),
                                     grey);
  }

  std::vector<std::uint8_t> drawn(const LegendEntries& legend, core::ImageSize size, std::uint8_t grey = 200) {
    std::vector<std::uint8_t> pixels = plain(size, grey);
    drawLegend(pixels, size, legend, typeface_);
    return pixels;
  }

  static std::array<int, 3> pixelAt(const std::vector<std::uint8_t>& pixels, core::ImageSize size, int x, int y) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x));
    return {pixels[at], pixels[at + 1], pixels[at + 2]};
  }

  Typeface typeface_;
};

TEST_P(LegendPicture, StandsInTheLowerRightCorner) {
  const core::ImageSize size = GetParam();
  ASSERT_TRUE(legendFits(size, 1));
  const LegendLayout layout = layOut({bar()}, size);
  ASSERT_EQ(layout.panels.size(), 1U);
  const PixelBounds& panel = layout.panels[0];
  EXPECT_GE(panel.left, 0);
  EXPECT_GE(panel.top, 0);
  EXPECT_LT(panel.right, size.width);
  EXPECT_LT(panel.bottom, size.height);
  EXPECT_EQ(size.width - panel.right, size.height - panel.bottom) << "one margin";
  EXPECT_GE(layout.em, 10);
  if (size.height >= 500 && size.width >= size.height) {
    EXPECT_NEAR(layout.em, 0.02 * size.height, 0.51);
  }
}

TEST_P(LegendPicture, ChangesNothingOutsideItsPanels) {
  const core::ImageSize size = GetParam();
  const LegendEntries legend =
      legendFits(size, 3) ? LegendEntries{bar(), NormalBall{"Normal"}, bar()} : LegendEntries{bar()};
  const std::vector<PixelBounds> panels = layOut(legend, size).panels;
  const std::vector<std::uint8_t> before = plain(size, 200);
  const std::vector<std::uint8_t> after = drawn(legend, size);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto x = static_cast<int>(i / 4 % static_cast<std::size_t>(size.width));
    const auto y = static_cast<int>(i / 4 / static_cast<std::size_t>(size.width));
    const bool within = std::ranges::any_of(panels, [&](const PixelBounds& panel) {
      return x >= panel.left && x < panel.right && y >= panel.top && y < panel.bottom;
    });
    if (!within || i % 4 == 3) {
      ASSERT_EQ(after[i], before[i]) << x << ", " << y;
    } else if (after[i] != before[i]) {
      ++changed;
    }
  }
  EXPECT_GT(changed, 1000U);
}

TEST_P(LegendPicture, IsTheSameAgain) {
  EXPECT_EQ(drawn({bar()}, GetParam()), drawn({bar()}, GetParam()));
  EXPECT_NE(drawn({bar()}, GetParam()), drawn({}, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Sizes, LegendPicture,
                         ::testing::Values(core::ImageSize{160, 120}, core::ImageSize{320, 240},
                                           core::ImageSize{1280, 720}, core::ImageSize{3840, 2160},
                                           core::ImageSize{200, 1200}));

TEST_F(LegendPicture, IsLeftOutOfSmallPictures) {
  EXPECT_TRUE(legendFits({160, 120}, 1));
  EXPECT_FALSE(legendFits({159, 120}, 1));
  EXPECT_FALSE(legendFits({160, 119}, 1));
  EXPECT_FALSE(legendFits({160, 120}, 4)) << "more than stand one above the other";
  EXPECT_TRUE(legendFits({1280, 720}, kMostLiquids));
}

TEST_F(LegendPicture, StacksItsPanels) {
  const std::vector<PixelBounds> panels = layOut({bar(), bar(), bar()}, {1280, 720}).panels;
  ASSERT_EQ(panels.size(), 3U);
  EXPECT_LT(panels[0].bottom, panels[1].top);
  EXPECT_LT(panels[1].bottom, panels[2].top);
  EXPECT_EQ(panels[0].left, panels[2].left);
}

TEST_F(LegendPicture, ShowsEveryColourOfTheBarInOrder) {
  const core::ImageSize size{1280, 720};
  const std::vector<std::uint8_t> pixels = drawn({bar()}, size);
  const LegendLayout layout = layOut({bar()}, size);
  const PixelBounds& panel = layout.panels[0];
  // Some row shows nothing but the bar's colours between the paddings: from its first to its last, each no less.
  const int left = panel.left + layout.padding;
  const int right = panel.right - layout.padding;
  const auto isBar = [&](int y) {
    for (int x = left; x < right; ++x) {
      const auto [red, green, blue] = pixelAt(pixels, size, x, y);
      const double share = (x - left + 0.5) / (right - left);
      if (green != 40 || blue != 90 || std::abs(red - 255 * share) > 1) return false;
    }
    return true;
  };
  int rows = 0;
  for (int y = panel.top; y < panel.bottom; ++y) rows += isBar(y) ? 1 : 0;
  EXPECT_NEAR(rows, 0.75 * layout.em, 1);
}

TEST_F(LegendPicture, HasTextThatReadsOnAnyBackground) {
  const core::ImageSize size{1280, 720};
  const LegendLayout layout = layOut({bar()}, size);
  const PixelBounds& panel = layout.panels[0];
  for (const int grey : {0, 128, 255}) {
    const std::vector<std::uint8_t> pixels = drawn({bar()}, size, static_cast<std::uint8_t>(grey));
    int light = 0;
    int dark = 0;
    for (int y = panel.top + layout.padding; y < panel.top + 2 * layout.padding; ++y) {
      for (int x = panel.left + layout.padding; x < panel.right - layout.padding; ++x) {
        const int level = pixelAt(pixels, size, x, y)[1];
        light += level > 200 ? 1 : 0;
        dark += level < 95 ? 1 : 0;
      }
    }
    // Letters, and around them the panel; on white that is grey 84 under grey 239, a contrast of 6.6 : 1.
    EXPECT_GT(light, 30) << grey;
    EXPECT_GT(dark, 10 * light) << grey;
  }
  ColourBar other = bar();
  other.title = "Pressure";
  EXPECT_NE(drawn({bar()}, size), drawn({other}, size));
  other = bar();
  other.range = {0, 4};
  EXPECT_NE(drawn({bar()}, size), drawn({other}, size)) << "other ticks";
}

TEST_F(LegendPicture, KeepsLongTitlesWithinThePanel) {
  ColourBar longTitle = bar();
  longTitle.title = "Density error, liquid 8";
  const core::ImageSize size{320, 240};
  // Written over the left part alone, had it been cut off: the last letters are what is left of the right padding.
  const LegendLayout layout = layOut({longTitle}, size);
  const std::vector<std::uint8_t> pixels = drawn({longTitle}, size);
  const PixelBounds& panel = layout.panels[0];
  for (int y = panel.top + 3; y < panel.top + layout.padding + layout.em; ++y) {
    for (int x = panel.right - layout.padding; x < panel.right - 4; ++x) {
      EXPECT_LT(pixelAt(pixels, size, x, y)[1], 100) << x << ", " << y;
    }
  }
}

TEST(Typeface, HasTheCharactersOfLegends) {
  Typeface typeface;
  const Glyph missing = typeface.glyph(0xE000, 20);
  for (const char32_t character : charactersOf("Speed (m/s) 0123456789.,−%µ⁰¹²³⁴⁵⁶⁷⁸⁹⁻")) {
    const Glyph& glyph = typeface.glyph(character, 20);
    EXPECT_TRUE(character == ' ' || glyph.coverage != missing.coverage) << static_cast<std::uint32_t>(character);
    EXPECT_GT(glyph.advance, 0);
  }
  const Glyph& h = typeface.glyph('H', 20);
  // DejaVu's capitals are 0.729 of an em high.
  EXPECT_NEAR(h.above, 0.729 * 20, 1);
  EXPECT_EQ(typeface.widthOf("HH", 20), 2 * h.advance);
  EXPECT_EQ(&h, &typeface.glyph('H', 20)) << "drawn once";
}

TEST(LegendEntries, TellWhatEveryStudyViewShows) {
  v1::Scene scene;
  scene::complete(scene);
  const google::protobuf::OneofDescriptor& views = *v1::View::descriptor()->FindOneofByName("shows");
  std::vector<std::string> titles;
  for (int i = 0; i < views.field_count(); ++i) {
    v1::View& view = *scene.mutable_view();
    view.GetReflection()->MutableMessage(&view, views.field(i));
    if (!showsValues(view)) continue;
    const LegendEntry entry = studyEntry(view, {0, 1}, 0.02, shownColours(paletteOf(view), forItsView(scene).tone()));
    titles.push_back(std::visit([](const auto& e) { return e.title; }, entry));
    const auto* const bar = std::get_if<ColourBar>(&entry);
    EXPECT_EQ(bar == nullptr, view.has_normals());
    if (bar != nullptr) {
      EXPECT_EQ(bar->colours.size(), 256U) << titles.back();
    }
  }
  EXPECT_THAT(titles, ElementsAre("Depth of the splats", "Depth of the surface", "Normal", "Mean curvature",
                                  "Thickness", "Height of the noise", "Share hidden by foam"));
}

TEST(LegendEntries, MeasureCurvatureInOneOverMetres) {
  v1::Scene scene;
  scene.mutable_view()->mutable_curvature();
  const LegendEntry entry = studyEntry(scene.view(), {-0.25F, 0.25F}, 0.05, {});
  const auto& bar = std::get<ColourBar>(entry);
  EXPECT_NEAR(bar.range.most, 5, 1e-4F);
  EXPECT_EQ(bar.unit, "1/m");
  EXPECT_EQ(bar.colours.front(), (Rgb8{255, 0, 0}));
  EXPECT_EQ(bar.colours.back(), (Rgb8{0, 255, 0}));
}

}  // namespace
}  // namespace sluice::render
