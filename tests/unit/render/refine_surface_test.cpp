#include "refine_surface.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sluice::render {
namespace {

constexpr float kEdge = 0.1F;  // m

core::ImageSize half(core::ImageSize size) { return {(size.width + 1) / 2, (size.height + 1) / 2}; }

/// f(x, y) in fine pixels from the middle, at the middles of `size` pixels that are `step` of them wide.
template <class Function>
std::vector<float> sampled(core::ImageSize size, float step, const Function& f) {
  std::vector<float> values;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      values.push_back(f(step * (static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(size.width)),
                         step * (static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(size.height))));
    }
  }
  return values;
}

template <class Function>
std::vector<float> refined(core::ImageSize size, const Function& f) {
  std::vector<float> fine(static_cast<std::size_t>(size.width * size.height));
  refineSurface(sampled(half(size), 2, f), half(size), kEdge, fine, size);
  return fine;
}

TEST(RefineSurface, KeepsAPlaneWhateverTheSize) {
  const auto plane = [](float x, float y) { return 0.5F + 1e-3F * x - 2e-3F * y; };
  for (const core::ImageSize size : {core::ImageSize{24, 18}, {25, 18}, {24, 17}, {25, 17}}) {
    const std::vector<float> fine = refined(size, plane);
    const std::vector<float> exact = sampled(size, 1, plane);
    for (int y = 1; y + 1 < size.height; ++y) {
      for (int x = 1; x + 1 < size.width; ++x) {
        const auto at = static_cast<std::size_t>(y * size.width + x);
        ASSERT_NEAR(fine[at], exact[at], 1e-6F) << size.width << "x" << size.height << " at " << x << ", " << y;
      }
    }
  }
}

TEST(RefineSurface, DoesNotBlendAcrossAStep) {
  const auto step = [](float x, float) { return x < 0 ? 0.5F : 0.25F; };  // 2 m and 4 m
  for (const float q : refined({24, 18}, step)) EXPECT_TRUE(q == 0.5F || q == 0.25F) << q;
}

TEST(RefineSurface, BlendsWhereDepthsAreWithinTheEdge) {
  const auto step = [](float x, float) { return 1.0F / (x < 0 ? 2.0F : 2.05F); };
  int between = 0;
  for (const float q : refined({24, 18}, step)) between += q < 1 / 2.0F && q > 1 / 2.05F ? 1 : 0;
  EXPECT_EQ(between, 2 * 18);
}

TEST(RefineSurface, LiquidReachesHalfAPixelBeyondItsOutline) {
  const auto disc = [](float x, float y) { return x * x + y * y < 36 ? 0.5F : 0.0F; };
  const core::ImageSize size{24, 18};
  const std::vector<float> fine = refined(size, disc);
  const std::vector<float> exact = sampled(size, 1, disc);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    EXPECT_TRUE(fine[i] == 0.0F || fine[i] == 0.5F);
    // A back that the front lies over is never missing.
    EXPECT_GE(fine[i], 0.999F * exact[i]) << i;
  }
}

}  // namespace
}  // namespace sluice::render
