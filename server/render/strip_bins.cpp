#include "strip_bins.h"

namespace sluice::render {

void StripBins::fill(std::span<const PixelBounds> bounds, int height, int stripRows) {
  const auto strips = static_cast<std::size_t>((height + stripRows - 1) / stripRows);
  const auto forEachMet = [&](auto&& action) {
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (bounds[i].isEmpty()) continue;
      for (int s = bounds[i].top / stripRows; s <= (bounds[i].bottom - 1) / stripRows; ++s) {
        action(static_cast<std::size_t>(s), static_cast<std::uint32_t>(i));
      }
    }
  };
  start_.assign(strips + 1, 0);
  forEachMet([&](std::size_t strip, std::uint32_t) { ++start_[strip + 1]; });
  for (std::size_t s = 0; s < strips; ++s) start_[s + 1] += start_[s];
  order_.resize(start_[strips]);
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  forEachMet([&](std::size_t strip, std::uint32_t i) { order_[next[strip]++] = i; });
}

}  // namespace sluice::render
