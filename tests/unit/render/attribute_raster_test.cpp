// Values of particles brought to the surface on the CPU, against the obvious sum over all particles, and what it
// promises.
#include "attribute_raster.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace sluice::render {
namespace {

const ViewGeometry kSurfaceView = makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45.0F}, {171, 110});
const ViewGeometry kView = divided(kSurfaceView, 2);
constexpr float kDepth = 2;
constexpr float kSpacing = 0.06F;
constexpr float kRadius = 0.9F * kSpacing;

/// A jittered layer of particles parallel to the picture, beyond all its edges.
std::vector<ViewValue> layer(const std::function<float(float x, float y)>& value, float depth = kDepth) {
  std::vector<ViewValue> particles;
  std::mt19937 random(5);
  const auto jitter = [&] {
    return 0.2F * kSpacing * (2.0F * static_cast<float>(random() >> 8) / static_cast<float>(1U << 24) - 1.0F);
  };
  for (float y = -1.2F; y <= 1.2F; y += kSpacing) {
    for (float x = -1.6F; x <= 1.6F; x += kSpacing) {
      const float px = x + jitter();
      const float py = y + jitter();
      particles.push_back({px, py, depth + jitter(), value(px, py)});
    }
  }
  return particles;
}

std::size_t pixels(const ViewGeometry& view) {
  return static_cast<std::size_t>(view.size.width) * static_cast<std::size_t>(view.size.height);
}

std::vector<float> flat() { return std::vector<float>(pixels(kSurfaceView), 1.0F / kDepth); }

std::vector<float> draw(std::span<const ViewValue> particles, std::span<const float> surface) {
  std::vector<float> result(pixels(kView), -1.0F);
  AttributeRaster().draw(particles, kRadius, surface, kSurfaceView, kView, result);
  return result;
}

Eigen::Vector2f slopeOf(std::size_t pixel) {
  const auto x = static_cast<float>(pixel % static_cast<std::size_t>(kView.size.width));
  const auto y = static_cast<float>(pixel / static_cast<std::size_t>(kView.size.width));
  return kView.pixelSlope * Eigen::Vector2f(x + 0.5F - 0.5F * static_cast<float>(kView.size.width),
                                            y + 0.5F - 0.5F * static_cast<float>(kView.size.height));
}

TEST(AttributeRaster, MatchesTheSumOverAllParticles) {
  std::vector<ViewValue> particles = layer([](float x, float y) { return std::sin(9 * x) + y; });
  const std::vector<ViewValue> behind = layer([](float, float) { return 5.0F; }, kDepth + 0.1F);
  particles.insert(particles.end(), behind.begin(), behind.end());
  // A slope, and a hole.
  std::vector<float> surface = flat();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::size_t x = i % 171;
    if (x > 60) surface[i] = 1.0F / (kDepth + 0.001F * static_cast<float>(x));
    if (x > 130) surface[i] = 0;
  }
  const std::vector<float> drawn = draw(particles, surface);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Eigen::Vector2d slope = slopeOf(i).cast<double>();
    const Eigen::Vector2i at = (kSurfaceView.toPixel(slopeOf(i))).array().floor().cast<int>();
    const double q = surface[static_cast<std::size_t>(std::clamp(at.y(), 0, 109) * 171 + std::clamp(at.x(), 0, 170))];
    double sum = 0;
    double weights = 0;
    for (const ViewValue& p : particles) {
      const double across = std::max<double>(kValueReach * kRadius, kValueLeastPixels * kView.pixelSlope * p.z);
      const double rho = (Eigen::Vector2d(p.x, p.y) - p.z * slope).norm() / across;
      const double delta = q > 0 ? (p.z - 1 / q) / (kValueDepthReach * kRadius) : 1e9;
      const double weight = std::pow(std::max(0.0, 1 - rho * rho), 2) *
                            (static_cast<double>(kValueEverywhere) + std::pow(std::max(0.0, 1 - delta * delta), 2));
      sum += weight * static_cast<double>(p.value);
      weights += weight;
    }
    ASSERT_NEAR(drawn[i], sum / weights, 2e-4) << i;
  }
}

TEST(AttributeRaster, KeepsAConstantField) {
  const std::vector<float> drawn = draw(layer([](float, float) { return 3.5F; }), flat());
  for (const float value : drawn) ASSERT_NEAR(value, 3.5F, 1e-5F);
}

TEST(AttributeRaster, ReproducesALinearRamp) {
  const std::vector<float> drawn = draw(layer([](float x, float y) { return 10 * x - 4 * y; }), flat());
  double error = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Eigen::Vector2f place = kDepth * slopeOf(i);
    // Jitter of a fifth of a spacing moves the mean of some ten neighbours by a fraction of that.
    ASSERT_NEAR(drawn[i], 10 * place.x() - 4 * place.y(), 0.2F * 10 * kSpacing) << i;
    error += std::abs(static_cast<double>(drawn[i] - (10 * place.x() - 4 * place.y())));
  }
  EXPECT_LT(error / static_cast<double>(drawn.size()), 0.05 * 10 * kSpacing);
}

TEST(AttributeRaster, ShowsWhatIsAtTheSurface) {
  std::vector<ViewValue> particles = layer([](float, float) { return 1.0F; });
  const std::vector<ViewValue> behind = layer([](float, float) { return 100.0F; }, kDepth + 4 * kRadius);
  particles.insert(particles.end(), behind.begin(), behind.end());
  for (const float value : draw(particles, flat())) ASSERT_NEAR(value, 1.0F, 1e-2F);
}

TEST(AttributeRaster, IsNothingWhereNoParticleIs) {
  const std::vector<ViewValue> one{{0, 0, kDepth, 7}};
  const std::vector<float> drawn = draw(one, flat());
  EXPECT_EQ(std::ranges::count(drawn, 0.0F) + std::ranges::count_if(drawn, [](float v) { return v > 6.99F; }),
            static_cast<std::ptrdiff_t>(drawn.size()));
  EXPECT_EQ(drawn.front(), 0.0F);
  EXPECT_NEAR(drawn[static_cast<std::size_t>(27 * kView.size.width + 43)], 7.0F, 1e-5F);
}

TEST(AttributeRaster, IsTheSameForAnyNumberOfThreads) {
  const std::vector<ViewValue> particles = layer([](float x, float y) { return std::sin(30 * x) * y; });
  const int before = omp_get_max_threads();
  std::vector<std::vector<float>> results;
  for (const int threads : {1, 2, 4}) {
    omp_set_num_threads(threads);
    results.push_back(draw(particles, flat()));
  }
  omp_set_num_threads(before);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

}  // namespace
}  // namespace sluice::render
