#include "smoothing/implicit_curvature_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sluice::render {
namespace {

constexpr core::ImageSize kSize{200, 150};
constexpr float kPixelSlope = 4e-3F;

FlowSettings settings(float time) {
  FlowSettings s;
  s.pixelSlope = kPixelSlope;
  s.time = time;
  s.edge = 0.2F;
  return s;
}

std::size_t at(int x, int y) { return static_cast<std::size_t>(y) * kSize.width + static_cast<std::size_t>(x); }

float slope(int pixel, int count) { return kPixelSlope * (static_cast<float>(pixel) + 0.5F - 0.5F * count); }

/// Inverse depth of the plane z = 2 + sx·x + sy·y inside a disc, 0 outside: q = (1 − sx·W_x − sy·W_y)/2.
std::vector<float> planeInDisc(float sx, float sy) {
  std::vector<float> q(static_cast<std::size_t>(kSize.width) * kSize.height, 0.0F);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (std::hypot(x - 90, y - 70) > 60) continue;
      q[at(x, y)] = 0.5F * (1.0F - sx * slope(x, kSize.width) - sy * slope(y, kSize.height));
    }
  }
  return q;
}

TEST(ImplicitCurvatureFlow, PlaneStaysAPlane) {
  const std::vector<float> plane = planeInDisc(0.8F, -0.5F);
  std::vector<float> q = plane;
  ImplicitCurvatureFlow().smooth(q, kSize, settings(0.02F));
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(q[i], plane[i], 2e-5F * plane[i]);
}

TEST(ImplicitCurvatureFlow, ClosesNarrowGapsAlone) {
  const std::vector<float> plane = planeInDisc(0.3F, -0.2F);
  FlowSettings s = settings(1e-9F);
  // Six pixels at q = 0.5.
  s.widestGap = 6.0F * kPixelSlope / 0.5F;
  std::vector<float> q = plane;
  const auto clear = [&](int left, int right, int top, int bottom) {
    for (int y = top; y < bottom; ++y) std::fill(q.begin() + at(left, y), q.begin() + at(right, y), 0.0F);
  };
  clear(70, 74, 40, 100);   // narrow across rows
  clear(100, 120, 60, 80);  // wide both ways
  ImplicitCurvatureFlow().smooth(q, kSize, s);
  EXPECT_NEAR(q[at(72, 70)], plane[at(72, 70)], 1e-4F);
  EXPECT_EQ(q[at(110, 70)], 0.0F);
  // Nothing is drawn outside the outline, which is convex.
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_TRUE(plane[i] > 0.0F || q[i] == 0.0F) << i;
}

TEST(ImplicitCurvatureFlow, BackgroundStaysEmpty) {
  const std::vector<float> plane = planeInDisc(0.2F, 0.1F);
  std::vector<float> q = plane;
  for (std::size_t i = 0; i < q.size(); i += 7) q[i] *= 1.01F;
  ImplicitCurvatureFlow().smooth(q, kSize, settings(0.02F));
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_EQ(q[i] > 0.0F, plane[i] > 0.0F);
}

/// Root mean square of (q − plane)/plane well inside the disc.
double roughness(const std::vector<float>& q, const std::vector<float>& plane) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (std::hypot(x - 90, y - 70) > 45) continue;
      const double d = q[at(x, y)] / plane[at(x, y)] - 1;
      sum += d * d;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(ImplicitCurvatureFlow, NoiseFades) {
  const std::vector<float> plane = planeInDisc(0.3F, 0.2F);
  std::vector<float> q = plane;
  std::mt19937 random(3);
  for (float& value : q) value *= 1.0F + 0.001F * (static_cast<float>(random() % 1000) / 500.0F - 1.0F);
  const double before = roughness(q, plane);
  ImplicitCurvatureFlow().smooth(q, kSize, settings(0.02F));
  EXPECT_LT(roughness(q, plane), 0.15 * before);
}

TEST(ImplicitCurvatureFlow, LongWavesFadeAsBackwardEulerSays) {
  // Facing the eye at z = 2 the flow is q_t = ½·q²·Δq... with A = q²/2·I at W = 0: a ripple of wave number k in slopes
  // shrinks by 1/(1 + Δt·q²·k²/2) a step, and so by the last short one.
  std::vector<float> q(static_cast<std::size_t>(kSize.width) * kSize.height);
  const float wavelengthPixels = 25.0F;
  const auto ripple = [&](int x) { return std::cos(2.0F * 3.14159265F * static_cast<float>(x) / wavelengthPixels); };
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) q[at(x, y)] = 0.5F + 1e-4F * ripple(x);
  }
  FlowSettings s = settings(0.01F);
  s.steps = 1;
  ImplicitCurvatureFlow().smooth(q, kSize, s);
  const double k = 2 * 3.14159265 / (wavelengthPixels * kPixelSlope);
  const double last = flowTimes(s).last;
  const double expected = 1e-4 / (1 + (s.time - last) * 0.25 * k * k / 2) / (1 + last * 0.25 * k * k / 2);
  double amplitude = 0;
  for (int x = 50; x < 150; ++x) amplitude += 2.0 * ripple(x) * (q[at(x, 75)] - 0.5) / 100;
  EXPECT_NEAR(amplitude, expected, 0.05 * expected);
}

TEST(ImplicitCurvatureFlow, StaysBoundedForAnyTime) {
  for (const float time : {1e-6F, 1.0F, 1e4F}) {
    std::vector<float> q(static_cast<std::size_t>(kSize.width) * kSize.height, 0.0F);
    std::mt19937 random(5);
    // Holes, jumps by a factor of a million, single pixels, and checkerboards.
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        const std::uint32_t r = random() % 16;
        q[at(x, y)] = r == 0 ? 0.0F : r == 1 ? 1e3F : r == 2 ? 1e-3F : (x + y) % 2 == 0 && y > 100 ? 0.0F : 0.5F;
      }
    }
    ImplicitCurvatureFlow().smooth(q, kSize, settings(time));
    for (const float value : q) {
      ASSERT_TRUE(std::isfinite(value));
      ASSERT_LE(value, 8e3F);
      ASSERT_GE(value, 0.0F);
    }
  }
}

TEST(ImplicitCurvatureFlow, TakesEveryPictureSize) {
  for (const core::ImageSize size : {core::ImageSize{1, 1}, {2, 3}, {17, 1}, {1, 64}, {129, 65}}) {
    std::vector<float> q(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height), 0.5F);
    ImplicitCurvatureFlow().smooth(q, size, settings(0.05F));
    for (const float value : q) EXPECT_NEAR(value, 0.5F, 1e-4F);
  }
}

}  // namespace
}  // namespace sluice::render
