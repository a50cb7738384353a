// Noise drawn on the CPU, against the obvious sum over all particles, and what it promises.
#include "noise_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace sluice::render {
namespace {

const ViewGeometry kView = makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45.0F}, {170, 110});
constexpr float kDepth = 2;

v1::Noise settings() {
  v1::Noise noise;
  noise.set_amplitude(0.4);
  noise.set_still_share(0.25);
  noise.set_radius_in_spacings(3);
  noise.set_octaves(3);
  noise.set_depth_in_spacings(1);
  return noise;
}

/// A jittered layer of particles parallel to the picture.
core::ParticleSnapshot layer(float spacing, const Eigen::Vector3f& shift = Eigen::Vector3f::Zero()) {
  core::ParticleSnapshot snapshot;
  snapshot.spacing = spacing;
  std::mt19937 random(5);
  const auto jitter = [&] {
    return 0.3F * spacing * (2.0F * static_cast<float>(random() >> 8) / static_cast<float>(1U << 24) - 1.0F);
  };
  for (float y = -1.2F; y <= 1.2F; y += spacing) {
    for (float x = -1.6F; x <= 1.6F; x += spacing) {
      const float px = x + jitter();
      const float py = y + jitter();
      snapshot.positions.push_back(Eigen::Vector3f(px, py, -kDepth + jitter()) + shift);
      snapshot.ids.push_back(static_cast<std::uint32_t>(snapshot.ids.size()));
    }
  }
  return snapshot;
}

std::vector<NoiseSprite> sprites(const core::ParticleSnapshot& particles, const v1::Noise& noise = settings(),
                                 std::span<const float> violence = {}, const ViewGeometry& view = kView) {
  SplatSelection all;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    all.points.particles.push_back(static_cast<std::uint32_t>(i));
  }
  return makeNoiseSprites(particles, all, violence, noise, view, 0.01F);
}

struct Drawn {
  std::vector<float> height;
  std::vector<float> violence;
};

Drawn draw(std::span<const NoiseSprite> given, float fallOff, std::span<const float> surface,
           const ViewGeometry& view = kView) {
  Drawn drawn;
  drawn.height.resize(surface.size(), -1.0F);
  drawn.violence.resize(surface.size(), -1.0F);
  NoiseRaster().draw(given, view, fallOff, surface, drawn.height, drawn.violence);
  return drawn;
}

std::size_t pixels(const ViewGeometry& view) {
  return static_cast<std::size_t>(view.size.width) * static_cast<std::size_t>(view.size.height);
}

/// A surface at one depth.
std::vector<float> flat(const ViewGeometry& view = kView) { return std::vector<float>(pixels(view), 1.0F / kDepth); }

/// Gradient noise in doubles, written for reading.
double noiseAt(double x, double y, std::uint32_t seed) {
  const auto gradientTimesWay = [&](double column, double row) {
    std::uint32_t hash =
        static_cast<std::uint32_t>(column) * 0x9e3779b1U + static_cast<std::uint32_t>(row) * 0x85ebca77U;
    hash += seed;
    hash = (hash ^ (hash >> 15)) * 0x2c1b3c6dU;
    hash ^= hash >> 14;
    const double gx = (hash & 0xffffU) / 65535.0 * 2 - 1;
    const double gy = (hash >> 16) / 65535.0 * 2 - 1;
    return gx * (x - column) + gy * (y - row);
  };
  const auto smooth = [](double t) { return t * t * t * (10 + t * (-15 + 6 * t)); };
  const double column = std::floor(x);
  const double row = std::floor(y);
  const double upper = std::lerp(gradientTimesWay(column, row), gradientTimesWay(column + 1, row), smooth(x - column));
  const double lower =
      std::lerp(gradientTimesWay(column, row + 1), gradientTimesWay(column + 1, row + 1), smooth(x - column));
  return std::lerp(upper, lower, smooth(y - row));
}

struct Statistics {
  double height = 0;  ///< Root mean square, m.
  double slope = 0;
};

/// Of the picture's middle, away from the edges of what is drawn.
Statistics statisticsOf(std::span<const float> height, const ViewGeometry& view = kView) {
  Statistics s;
  const int w = view.size.width;
  const int h = view.size.height;
  const double metre = view.pixelSlope * kDepth;
  int count = 0;
  for (int y = h / 8; y < 7 * h / 8; ++y) {
    for (int x = w / 8; x < 7 * w / 8; ++x) {
      const float* at = height.data() + static_cast<std::ptrdiff_t>(y) * w + x;
      s.height += at[0] * at[0];
      s.slope += std::pow((at[1] - at[-1]) / (2 * metre), 2) + std::pow((at[w] - at[-w]) / (2 * metre), 2);
      ++count;
    }
  }
  return {std::sqrt(s.height / count), std::sqrt(s.slope / count)};
}

TEST(NoiseRaster, MatchesTheSumOverAllParticles) {
  const core::ParticleSnapshot particles = layer(0.09F);
  std::vector<float> violence(particles.size());
  for (std::size_t i = 0; i < violence.size(); ++i) violence[i] = static_cast<float>(i % 5) / 4.0F;
  const std::vector<NoiseSprite> given = sprites(particles, settings(), violence);
  // A step, a slope, and a hole.
  std::vector<float> surface = flat();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const std::size_t x = i % 170;
    if (x > 60) surface[i] = 1.0F / (kDepth + 0.002F * static_cast<float>(x));
    if (x > 120) surface[i] = 0;
  }
  const Drawn drawn = draw(given, 0.09F, surface);
  double largest = 0;
  for (int y = 0; y < 110; ++y) {
    for (int x = 0; x < 170; ++x) {
      const auto at = static_cast<std::size_t>(y * 170 + x);
      if (surface[at] == 0) {
        ASSERT_EQ(drawn.height[at], 0.0F);
        ASSERT_EQ(drawn.violence[at], 0.0F);
        continue;
      }
      double sum = 0;
      double squares = 0;
      double violent = 0;
      for (const NoiseSprite& s : given) {
        const double lx = ((x + 0.5 - 85) * kView.pixelSlope * s.z - s.x) / s.radius;
        const double ly = ((y + 0.5 - 55) * kView.pixelSlope * s.z - s.y) / s.radius;
        const double below = (s.z - 1.0 / static_cast<double>(surface[at])) / 0.09;
        const double weight =
            std::pow(std::max(0.0, 1 - lx * lx - ly * ly), 2) * std::pow(std::max(0.0, 1 - below * below / 4), 4);
        if (weight == 0) continue;
        sum += weight * s.height *
               noiseAt(s.originX + s.turnX * lx - s.turnY * ly, s.originY + s.turnY * lx + s.turnX * ly, s.seed);
        squares += weight * weight;
        violent += weight * weight * s.violence;
      }
      const double least = kNoiseLeastWeight * kNoiseLeastWeight;
      largest = std::max(largest, std::abs(sum / std::sqrt(squares + least)));
      ASSERT_NEAR(drawn.height[at], sum / std::sqrt(squares + least), 2e-6) << x << ", " << y;
      ASSERT_NEAR(drawn.violence[at], violent / (squares + least), 2e-4) << x << ", " << y;
    }
  }
  EXPECT_GT(largest, 0.005);
}

TEST(NoiseRaster, HasTheSlopeThatTheLookAsksFor) {
  const core::ParticleSnapshot particles = layer(0.09F);
  const std::vector<float> violent(particles.size(), 1.0F);
  const v1::Noise noise = settings();
  const Statistics s = statisticsOf(draw(sprites(particles, noise, violent), 0.09F, flat()).height);
  // Weights vary from pixel to pixel, which adds to the slope of the noise itself.
  EXPECT_NEAR(s.slope, noise.amplitude(), 0.25 * noise.amplitude());
  EXPECT_NEAR(s.height, typicalNoise(noise, 0.09F), 0.3F * typicalNoise(noise, 0.09F));
  const Statistics calm = statisticsOf(draw(sprites(particles, noise), 0.09F, flat()).height);
  EXPECT_NEAR(calm.slope, noise.still_share() * s.slope, 1e-3 * s.slope);
}

TEST(NoiseRaster, IsAsStrongHoweverManyParticlesThereAre) {
  // Three layers in one place instead of one.
  const core::ParticleSnapshot one = layer(0.09F);
  core::ParticleSnapshot three = one;
  for (int k = 1; k < 3; ++k) {
    for (std::size_t i = 0; i < one.size(); ++i) {
      three.positions.push_back(one.positions[i] + Eigen::Vector3f(0.03F, 0.02F, 0) * static_cast<float>(k));
      three.ids.push_back(static_cast<std::uint32_t>(three.ids.size()));
    }
  }
  const std::vector<float> marks(three.size(), 0.5F);
  const Drawn thin = draw(sprites(one, settings(), marks), 0.09F, flat());
  const Drawn dense = draw(sprites(three, settings(), marks), 0.09F, flat());
  const Statistics a = statisticsOf(thin.height);
  const Statistics b = statisticsOf(dense.height);
  EXPECT_NEAR(b.height, a.height, 0.15 * a.height);
  EXPECT_NEAR(b.slope, a.slope, 0.15 * a.slope);
  const std::size_t middle = 55 * 170 + 85;
  EXPECT_NEAR(thin.violence[middle], 0.5F, 0.02F);
  EXPECT_NEAR(dense.violence[middle], 0.5F, 0.02F);
}

TEST(NoiseRaster, DoesNotDependOnTheOrderOfTheParticles) {
  const core::ParticleSnapshot given = layer(0.09F);
  core::ParticleSnapshot other = given;
  std::ranges::reverse(other.positions);
  std::ranges::reverse(other.ids);
  const Drawn a = draw(sprites(given), 0.09F, flat());
  const Drawn b = draw(sprites(other), 0.09F, flat());
  for (std::size_t i = 0; i < a.height.size(); ++i) ASSERT_NEAR(a.height[i], b.height[i], 1e-7F);
}

TEST(NoiseRaster, MovesWithTheParticles) {
  // By 7 pixels to the right and 4 down: y is down in pictures.
  const float pixel = kView.pixelSlope * kDepth;
  core::ParticleSnapshot here = layer(0.09F);
  for (Eigen::Vector3f& p : here.positions) p.z() = -kDepth;
  core::ParticleSnapshot there = here;
  for (Eigen::Vector3f& p : there.positions) p += Eigen::Vector3f(7 * pixel, -4 * pixel, 0);
  const Drawn a = draw(sprites(here), 0.09F, flat());
  const Drawn b = draw(sprites(there), 0.09F, flat());
  const double typical = statisticsOf(a.height).height;
  for (int y = 30; y < 90; ++y) {
    for (int x = 30; x < 140; ++x) {
      ASSERT_NEAR(b.height[static_cast<std::size_t>(y * 170 + x)],
                  a.height[static_cast<std::size_t>((y - 4) * 170 + x - 7)], 1e-3 * typical)
          << x << ", " << y;
    }
  }
}

TEST(NoiseRaster, ScalesWithDistance) {
  // Twice as many pixels are the same view from half as far: each second pixel's corner is a coarse pixel's middle.
  const ViewGeometry fine = makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45.0F}, {340, 220});
  const core::ParticleSnapshot particles = layer(0.15F);
  v1::Noise noise = settings();
  noise.set_octaves(1);
  const Drawn coarse = draw(sprites(particles, noise), 0.15F, flat());
  const Drawn sharp = draw(sprites(particles, noise, {}, fine), 0.15F, flat(fine), fine);
  const double typical = statisticsOf(coarse.height).height;
  for (int y = 10; y < 100; ++y) {
    for (int x = 10; x < 160; ++x) {
      const auto at = static_cast<std::size_t>(2 * y * 340 + 2 * x);
      const float mean =
          0.25F * (sharp.height[at] + sharp.height[at + 1] + sharp.height[at + 340] + sharp.height[at + 341]);
      ASSERT_NEAR(coarse.height[static_cast<std::size_t>(y * 170 + x)], mean, 0.05 * typical) << x << ", " << y;
    }
  }
}

TEST(NoiseRaster, FadesWherePixelsNoLongerShowIt) {
  v1::Noise noise = settings();
  noise.set_octaves(1);
  // Pixels are 0.015 m there; cells are 1.5 spacings.
  const double rough = statisticsOf(draw(sprites(layer(0.04F), noise), 0.04F, flat()).height).slope;
  const double smooth = statisticsOf(draw(sprites(layer(0.012F), noise), 0.012F, flat()).height).slope;
  const double none = statisticsOf(draw(sprites(layer(0.0099F), noise), 0.0099F, flat()).height).slope;
  EXPECT_GT(rough, 0.07);
  EXPECT_LT(smooth, 0.5 * rough);
  EXPECT_LT(none, 1e-6);
}

TEST(NoiseSprites, GiveEveryOctaveAsMuchOfTheSurface) {
  v1::Noise noise = settings();
  for (const unsigned octaves : {1U, 2U, 3U, 5U}) {
    noise.set_octaves(octaves);
    core::ParticleSnapshot particles;
    particles.spacing = 0.001;
    particles.positions.assign(40000, Eigen::Vector3f(0, 0, -kDepth));
    std::map<unsigned, double> area;
    const std::vector<NoiseSprite> all =
        sprites(particles, noise, {}, makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.2F}, {400, 400}));
    for (std::size_t i = 0; i < all.size(); ++i) {
      area[octaveOf(scrambled(static_cast<std::uint32_t>(i)), noise)] += all[i].radius * all[i].radius;
    }
    ASSERT_EQ(area.size(), octaves);
    for (const auto& [octave, sum] : area) EXPECT_NEAR(sum, area[0], 0.2 * area[0]) << octave << " of " << octaves;
  }
}

TEST(NoiseSprites, LeaveOutWhatIsBehindTheEye) {
  core::ParticleSnapshot particles;
  particles.spacing = 0.1;
  particles.positions = {{0, 0, -1}, {0, 0, 1}, {0, 0, 0}, {0, 0, -2}};
  const std::vector<NoiseSprite> all = sprites(particles);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].z, 1.0F);
  EXPECT_EQ(all[1].z, 2.0F);
}

TEST(NoiseSprites, AreTheSameForOneIdWhereverItStands) {
  core::ParticleSnapshot particles = layer(0.2F);
  core::ParticleSnapshot other = particles;
  std::ranges::rotate(other.positions, other.positions.begin() + 9);
  std::ranges::rotate(other.ids, other.ids.begin() + 9);
  const std::vector<NoiseSprite> a = sprites(particles);
  const std::vector<NoiseSprite> b = sprites(other);
  for (std::size_t i = 9; i < a.size(); ++i) {
    EXPECT_EQ(a[i].seed, b[i - 9].seed);
    EXPECT_EQ(a[i].originX, b[i - 9].originX);
    EXPECT_EQ(a[i].turnX, b[i - 9].turnX);
    EXPECT_EQ(a[i].height, b[i - 9].height);
  }
}

}  // namespace
}  // namespace sluice::render
