#include "metrics/mask.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace sluice::evaluate {
namespace {

template <class Inside>
Mask draw(core::ImageSize size, const Inside& inside) {
  Mask mask(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) mask.set[mask.index(x, y)] = inside(x, y) ? 1 : 0;
  }
  return mask;
}

Mask disc(double centreX, double radius) {
  return draw({64, 64}, [=](int x, int y) { return std::hypot(x - centreX, y - 32) < radius; });
}

TEST(Mask, DistanceMatchesNaive) {
  std::mt19937 random(3);
  const Mask mask = draw({37, 23}, [&](int, int) { return random() % 50 == 0; });
  const std::vector<double> squared = squaredDistanceTo(mask);
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int j = 0; j < 23; ++j) {
        for (int i = 0; i < 37; ++i) {
          if (mask.at(i, j)) nearest = std::min(nearest, double{1} * (i - x) * (i - x) + double{1} * (j - y) * (j - y));
        }
      }
      ASSERT_EQ(squared[mask.index(x, y)], nearest) << x << ", " << y;
    }
  }
}

TEST(Mask, DistanceToNothingIsInfinite) {
  for (const double d : squaredDistanceTo(Mask({5, 4}))) EXPECT_TRUE(std::isinf(d));
}

TEST(Mask, ShiftedOutlineIsAsFarAsItsShift) {
  EXPECT_EQ(hausdorffDistance(disc(32, 20), disc(32, 20)), 0);
  EXPECT_EQ(hausdorffDistance(disc(30, 20), disc(35, 20)), 5);
}

TEST(Mask, LonelyPixelCountsForTheOutline) {
  Mask stray = disc(20, 10);
  stray.set[stray.index(60, 32)] = 1;
  EXPECT_NEAR(hausdorffDistance(disc(20, 10), stray), 31, 0.5);
  EXPECT_NEAR(hausdorffDistance(stray, disc(20, 10)), 31, 0.5);
}

TEST(Mask, FullPicturesHaveNoOutline) {
  const Mask full = draw({8, 8}, [](int, int) { return true; });
  EXPECT_EQ(hausdorffDistance(full, full), 0);
  EXPECT_DOUBLE_EQ(hausdorffDistance(full, draw({8, 8}, [](int x, int) { return x < 4; })), std::hypot(8, 8));
}

TEST(Mask, OverlapIsThatOfTheAreas) {
  const Mask left = draw({10, 10}, [](int x, int) { return x < 6; });
  const Mask right = draw({10, 10}, [](int x, int) { return x >= 4; });
  EXPECT_DOUBLE_EQ(intersectionOverUnion(left, right), 0.2);
  EXPECT_DOUBLE_EQ(intersectionOverUnion(Mask({3, 3}), Mask({3, 3})), 1.0);
}

TEST(Mask, ErosionTakesTheMarginAndThePicturesEdge) {
  const Mask full = draw({20, 10}, [](int, int) { return true; });
  EXPECT_EQ(eroded(full, 2).count(), 16U * 6U);
  Mask hole = draw({21, 21}, [](int, int) { return true; });
  hole.set[hole.index(10, 10)] = 0;
  const Mask smaller = eroded(hole, 3);
  EXPECT_FALSE(smaller.at(13, 10));
  EXPECT_TRUE(smaller.at(14, 10));
  EXPECT_TRUE(smaller.at(12, 12)) << "four steps away along rows and columns";
}

TEST(Mask, EnlargingRepeatsPixels) {
  Mask small({2, 1});
  small.set = {1, 0};
  const Mask large = enlarged(small, 4, {7, 3});
  EXPECT_EQ(large.count(), 12U);
  EXPECT_TRUE(large.at(3, 2));
  EXPECT_FALSE(large.at(4, 0));
}

}  // namespace
}  // namespace sluice::evaluate
