#include "draw_legend.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "legend_layout.h"

namespace sluice::render {

namespace {

constexpr Rgb8 kPanel{16, 17, 20};
/// Dark enough for light text on a white picture, and light enough for the picture to be seen through.
constexpr float kPanelOpacity = 0.72F;
constexpr Rgb8 kText{238, 239, 241};
constexpr Rgb8 kFaint{150, 153, 158};

/// A panel of the picture; nothing is drawn beyond it.
class Canvas {
 public:
  Canvas(std::span<std::uint8_t> pixels, core::ImageSize size, const PixelBounds& panel)
      : pixels_(pixels),
        width_(size.width),
        left_(std::max<int>(panel.left, 0)),
        top_(std::max<int>(panel.top, 0)),
        right_(std::min<int>(panel.right, size.width)),
        bottom_(std::min<int>(panel.bottom, size.height)) {}

  /// Covers a share of a pixel, 0 to 1.
  void cover(int x, int y, const Rgb8& colour, float share) {
    if (x < left_ || x >= right_ || y < top_ || y >= bottom_) return;
    std::uint8_t* const pixel = pixels_.data() + 4 * (static_cast<std::ptrdiff_t>(y) * width_ + x);
    for (std::size_t c = 0; c < colour.size(); ++c) {
      pixel[c] = static_cast<std::uint8_t>(std::lround(std::lerp(pixel[c], colour[c], std::clamp(share, 0.0F, 1.0F))));
    }
  }

  void fill(int left, int right, int top, int bottom, const Rgb8& colour) {
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) cover(x, y, colour, 1.0F);
    }
  }

 private:
  std::span<std::uint8_t> pixels_;
  int width_;
  int left_, top_, right_, bottom_;
};

/// What is drawn with, of one panel.
struct Pen {
  Canvas canvas;
  Typeface& typeface;
  int em;
  int left, right;  ///< Of the content, pixels.
  int top;

  int ems(float count) const { return static_cast<int>(std::lround(count * static_cast<float>(em))); }
  int stroke() const { return std::max(1, em / 14); }

  void write(std::string_view text, int x, int baseLine, int pixels) {
    for (const char32_t character : charactersOf(text)) {
      const Glyph& glyph = typeface.glyph(character, pixels);
      for (int y = 0; y < glyph.size.height; ++y) {
        for (int column = 0; column < glyph.size.width; ++column) {
          const auto at = static_cast<std::size_t>(y * glyph.size.width + column);
          canvas.cover(x + glyph.left + column, baseLine - glyph.above + y, kText,
                       static_cast<float>(glyph.coverage[at]) / 255.0F);
        }
      }
      x += glyph.advance;
    }
  }

  /// The first line, in smaller letters where it is long.
  void writeTitle(std::string_view title) {
    constexpr int kSmallest = 7;
    int pixels = em;
    while (pixels > kSmallest && typeface.widthOf(title, pixels) > right - left) --pixels;
    write(title, left, top + ems(0.8F), pixels);
  }
};

void drawPanel(Canvas& canvas, const PixelBounds& panel, float radius) {
  const float halfWidth = 0.5F * static_cast<float>(panel.right - panel.left);
  const float halfHeight = 0.5F * static_cast<float>(panel.bottom - panel.top);
  for (int y = panel.top; y < panel.bottom; ++y) {
    for (int x = panel.left; x < panel.right; ++x) {
      // Distance from the rectangle within the rounded corners' middles.
      const float away = std::hypot(
          std::max(std::abs(static_cast<float>(x - panel.left) + 0.5F - halfWidth) - halfWidth + radius, 0.0F),
          std::max(std::abs(static_cast<float>(y - panel.top) + 0.5F - halfHeight) - halfHeight + radius, 0.0F));
      canvas.cover(x, y, kPanel, kPanelOpacity * std::clamp(radius - away + 0.5F, 0.0F, 1.0F));
    }
  }
}

/// A label and the middle of its tick.
struct Label {
  std::string text;
  int middle;
  int left;
  int right;
};

/// All of them where there is room; else every second, third or so, 0 among them.
std::vector<Label> thinned(const std::vector<Label>& labels, std::size_t zero, int gap) {
  for (std::size_t every = 1; every < labels.size(); ++every) {
    std::vector<Label> kept;
    for (std::size_t i = zero % every; i < labels.size(); i += every) kept.push_back(labels[i]);
    const auto collide = [&](const Label& a, const Label& b) { return a.right + gap > b.left; };
    if (std::ranges::adjacent_find(kept, collide) == kept.end()) return kept;
  }
  return {labels[zero]};
}

void drawTicks(Pen& pen, const ValueRange& range, const PixelBounds& panel, int top) {
  const Ticks ticks = ticksOf(range);
  const int stroke = pen.stroke();
  const int tick = pen.ems(0.25F);
  std::vector<Label> labels;
  std::size_t zero = 0;
  for (const double value : ticks.values) {
    const double share = (value - static_cast<double>(range.least)) / static_cast<double>(range.width());
    const int middle =
        std::clamp(pen.left + static_cast<int>(std::lround(share * (pen.right - pen.left) - 0.5 * stroke)), pen.left,
                   pen.right - stroke);
    pen.canvas.fill(middle, middle + stroke, top, top + tick, kText);
    if (value == 0.0) zero = labels.size();
    Label label{tickLabel(value, ticks.step), middle, 0, 0};
    const int width = pen.typeface.widthOf(label.text, pen.em);
    // Within the panel, with a little room.
    const int room = pen.ems(0.3F);
    label.left = std::clamp(middle + stroke / 2 - width / 2, panel.left + room,
                            std::max(panel.left + room, panel.right - room - width));
    label.right = label.left + width;
    labels.push_back(std::move(label));
  }
  if (labels.empty()) return;
  for (const Label& label : thinned(labels, zero, pen.ems(0.5F))) {
    pen.write(label.text, label.left, top + tick + pen.ems(0.95F), pen.em);
  }
}

void drawEntry(Pen& pen, const PixelBounds& panel, const ColourBar& given) {
  const ColourBar bar = withReadableUnit(given);
  pen.writeTitle(bar.unit.empty() ? bar.title : bar.title + " (" + bar.unit + ")");
  const int top = pen.top + pen.ems(1.3F);
  const int bottom = top + pen.ems(0.75F);
  // A hairline, so that the bar ends where its darkest colour is as dark as the panel.
  pen.canvas.fill(pen.left - 1, pen.right + 1, top - 1, bottom + 1, kFaint);
  const auto last = static_cast<float>(bar.colours.size() - 1);
  for (int x = pen.left; x < pen.right; ++x) {
    const float share = (static_cast<float>(x - pen.left) + 0.5F) / static_cast<float>(pen.right - pen.left);
    pen.canvas.fill(x, x + 1, top, bottom, bar.colours[static_cast<std::size_t>(std::lround(share * last))]);
  }
  drawTicks(pen, bar.range, panel, bottom + 1);
}

void drawBall(Pen& pen, float centreX, float centreY, float radius) {
  const int reach = static_cast<int>(std::ceil(radius)) + 1;
  const int firstX = static_cast<int>(centreX) - reach;
  const int firstY = static_cast<int>(centreY) - reach;
  for (int y = firstY; y <= firstY + 2 * reach; ++y) {
    for (int x = firstX; x <= firstX + 2 * reach; ++x) {
      const float dx = (static_cast<float>(x) + 0.5F - centreX) / radius;
      const float dy = (static_cast<float>(y) + 0.5F - centreY) / radius;
      const float away = std::hypot(dx, dy);
      // Beyond the rim, where half a pixel may still be covered, as at the rim.
      const float shrink = 1.0F / std::max(away, 1.0F);
      const float z = std::sqrt(std::max(1.0F - away * away, 0.0F));
      pen.canvas.cover(x, y, normalColour(dx * shrink, -dy * shrink, z),
                       std::clamp((1.0F - away) * radius + 0.5F, 0.0F, 1.0F));
    }
  }
}

void drawEntry(Pen& pen, const PixelBounds& /*panel*/, const NormalBall& ball) {
  pen.writeTitle(ball.title);
  const int top = pen.top + pen.ems(1.35F);
  const float radius = 2.2F * static_cast<float>(pen.em);
  drawBall(pen, static_cast<float>(pen.left) + radius, static_cast<float>(top) + radius, radius);
  struct Axis {
    std::string_view text;
    Rgb8 colour;
  };
  const std::array axes{Axis{"x to the right", normalColour(1, 0, 0)}, Axis{"y up", normalColour(0, 1, 0)},
                        Axis{"z to the eye", normalColour(0, 0, 1)}};
  const int swatch = pen.ems(0.75F);
  const int left = pen.left + pen.ems(5.3F);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const int y = top + pen.ems(0.35F + 1.5F * static_cast<float>(i));
    pen.canvas.fill(left, left + swatch, y, y + swatch, axes[i].colour);
    pen.write(axes[i].text, left + swatch + pen.ems(0.5F), y + pen.ems(0.74F), pen.em);
  }
}

}  // namespace

void drawLegend(std::span<std::uint8_t> pixels, core::ImageSize size, const LegendEntries& legend, Typeface& typeface) {
  const LegendLayout layout = layOut(legend, size);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const PixelBounds& panel = layout.panels[i];
    Pen pen{Canvas(pixels, size, panel), typeface, layout.em, panel.left + layout.padding, panel.right - layout.padding,
            panel.top + layout.padding};
    drawPanel(pen.canvas, panel, 0.4F * static_cast<float>(layout.em));
    std::visit([&](const auto& entry) { drawEntry(pen, panel, entry); }, legend[i]);
  }
}

}  // namespace sluice::render
