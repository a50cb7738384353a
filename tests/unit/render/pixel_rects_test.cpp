#include "pixel_rects.h"

#include <random>

#include <gtest/gtest.h>

namespace sluice::render {
namespace {

constexpr core::ImageSize kSize{40, 30};

/// How many of the rectangles cover each pixel.
std::vector<int> timesCovered(const std::vector<PixelRect>& rects) {
  std::vector<int> times(static_cast<std::size_t>(kSize.width * kSize.height));
  for (const PixelRect& rect : rects) {
    for (int y = rect.top; y < rect.bottom(); ++y) {
      for (int x = rect.left; x < rect.right(); ++x) ++times[static_cast<std::size_t>(y * kSize.width + x)];
    }
  }
  return times;
}

std::vector<PixelRect> randomRects(unsigned seed) {
  std::mt19937 random(seed);
  const auto upTo = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most + 1)); };
  std::vector<PixelRect> rects(random() % 7);
  for (PixelRect& rect : rects) {
    rect.left = upTo(kSize.width - 1);
    rect.top = upTo(kSize.height - 1);
    rect.width = upTo(std::min(12, kSize.width - rect.left));
    rect.height = upTo(std::min(12, kSize.height - rect.top));
  }
  return rects;
}

TEST(PixelRects, DisjointOnesCoverAllThatWasCoveredAndNothingTwice) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<PixelRect> rects = randomRects(seed);
    const std::vector<int> before = timesCovered(rects);
    const std::vector<int> after = timesCovered(disjoint(rects));
    for (std::size_t pixel = 0; pixel < before.size(); ++pixel) {
      ASSERT_LE(after[pixel], 1) << seed;
      ASSERT_GE(after[pixel], before[pixel] > 0 ? 1 : 0) << seed;
    }
  }
}

TEST(PixelRects, ThoseApartStayAsTheyAre) {
  const std::vector<PixelRect> rects{{0, 0, 5, 5}, {5, 0, 5, 5}, {20, 10, 3, 9}};
  EXPECT_EQ(disjoint(rects), rects);
}

TEST(PixelRects, ARectangleThatJoinsTwoOthersTakesBothIn) {
  EXPECT_EQ(disjoint({{0, 0, 5, 5}, {10, 0, 5, 5}, {4, 2, 7, 1}}), (std::vector<PixelRect>{{0, 0, 15, 5}}));
}

TEST(PixelRects, TheComplementCoversTheRestOnce) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<PixelRect> rects = disjoint(randomRects(seed));
    std::vector<PixelRect> all = complement(rects, kSize);
    all.insert(all.end(), rects.begin(), rects.end());
    for (const int times : timesCovered(all)) ASSERT_EQ(times, 1) << seed;
  }
}

}  // namespace
}  // namespace sluice::render
