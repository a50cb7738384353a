#include "legend_layout.h"

#include <algorithm>
#include <cmath>

namespace sluice::render {

namespace {

// In ems.
constexpr float kMargin = 0.9F;
constexpr float kPadding = 0.7F;
constexpr float kGap = 0.4F;
constexpr int kWidth = 17;
constexpr float kBarHeight = 4.6F;
constexpr float kBallHeight = 7.2F;

/// Below, a panel hides a large part of the picture.
constexpr core::ImageSize kLeastPicture{160, 120};

int emOf(core::ImageSize size) {
  constexpr int kLeast = 10;  // of what is read with ease
  const auto wanted = static_cast<int>(std::lround(0.02 * size.height));
  return std::max(kLeast, std::min(wanted, size.width / (kWidth + 1)));
}

int ems(float count, int em) { return static_cast<int>(std::lround(count * static_cast<float>(em))); }

int heightOf(const LegendEntry& entry, int em) {
  return ems(std::holds_alternative<NormalBall>(entry) ? kBallHeight : kBarHeight, em);
}

}  // namespace

LegendLayout layOut(const LegendEntries& legend, core::ImageSize size) {
  LegendLayout layout;
  layout.em = emOf(size);
  layout.padding = ems(kPadding, layout.em);
  const int margin = ems(kMargin, layout.em);
  const int right = size.width - margin;
  const int left = right - std::min(kWidth * layout.em, size.width - 2 * margin);
  int bottom = size.height - margin;
  for (auto entry = legend.rbegin(); entry != legend.rend(); ++entry) {
    const int top = bottom - heightOf(*entry, layout.em);
    layout.panels.push_back({static_cast<std::int16_t>(left), static_cast<std::int16_t>(right),
                             static_cast<std::int16_t>(top), static_cast<std::int16_t>(bottom)});
    bottom = top - ems(kGap, layout.em);
  }
  std::ranges::reverse(layout.panels);
  return layout;
}

bool legendFits(core::ImageSize size, std::size_t entries) {
  if (size.width < kLeastPicture.width || size.height < kLeastPicture.height) return false;
  const LegendLayout layout = layOut(LegendEntries(entries, ColourBar{}), size);
  return entries == 0 || layout.panels.front().top >= 0;
}

}  // namespace sluice::render
