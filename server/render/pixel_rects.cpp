#include "pixel_rects.h"

#include <algorithm>
#include <set>

namespace sluice::render {

namespace {

PixelRect around(const PixelRect& a, const PixelRect& b) {
  const int left = std::min(a.left, b.left);
  const int top = std::min(a.top, b.top);
  return {left, top, std::max(a.right(), b.right()) - left, std::max(a.bottom(), b.bottom()) - top};
}

}  // namespace

std::vector<PixelRect> disjoint(std::vector<PixelRect> rects) {
  std::erase_if(rects, &PixelRect::isEmpty);
  for (std::size_t i = 0; i < rects.size();) {
    const auto other = std::find_if(rects.begin() + static_cast<std::ptrdiff_t>(i) + 1, rects.end(),
                                    [&](const PixelRect& rect) { return rect.meets(rects[i]); });
    if (other == rects.end()) {
      ++i;
      continue;
    }
    rects[i] = around(rects[i], *other);
    rects.erase(other);
    i = 0;  // It may meet one of those before it now.
  }
  return rects;
}

std::vector<PixelRect> complement(std::span<const PixelRect> rects, core::ImageSize size) {
  std::set<int> edges{0, size.height};
  for (const PixelRect& rect : rects) {
    edges.insert(std::clamp(rect.top, 0, size.height));
    edges.insert(std::clamp(rect.bottom(), 0, size.height));
  }
  std::vector<PixelRect> rest;
  for (auto top = edges.begin(), bottom = std::next(top); bottom != edges.end(); ++top, ++bottom) {
    // No rectangle begins or ends between the two.
    std::vector<PixelRect> met;
    std::ranges::copy_if(rects, std::back_inserter(met), [&](const PixelRect& rect) {
      return !rect.isEmpty() && rect.top <= *top && rect.bottom() >= *bottom;
    });
    std::ranges::sort(met, {}, &PixelRect::left);
    int from = 0;
    for (const PixelRect& rect : met) {
      if (rect.left > from) rest.push_back({from, *top, rect.left - from, *bottom - *top});
      from = std::max(from, rect.right());
    }
    if (from < size.width) rest.push_back({from, *top, size.width - from, *bottom - *top});
  }
  return rest;
}

}  // namespace sluice::render
