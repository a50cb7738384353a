// What the CPU draws has the same bits for 1, 2 and 4 threads.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "attribute_raster.h"
#include "foam_dots.h"
#include "line_smoothing.h"
#include "noise_raster.h"
#include "sluice/scene/scene.h"
#include "smoothing/explicit_flow.h"
#include "smoothing/implicit_curvature_flow.h"
#include "splat_raster.h"
#include "thickness_smoothing.h"

namespace sluice::render {
namespace {

// A width that is no multiple of a block, a height that is none of a strip's.
const ViewGeometry kView = makeViewGeometry({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 60.0F}, {333, 251});
constexpr std::size_t kCount = 3000;

std::vector<float> picture() {
  return std::vector<float>(static_cast<std::size_t>(kView.size.width) * static_cast<std::size_t>(kView.size.height));
}

/// A surface that rises and falls, and ends.
std::vector<float> surface() {
  std::vector<float> q = picture();
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto width = static_cast<std::size_t>(kView.size.width);
    const auto x = static_cast<float>(i % width);
    const auto y = static_cast<float>(i / width);
    if (x + y > 60) q[i] = 1.0F / (2.0F + 0.2F * std::sin(0.07F * x) * std::cos(0.05F * y));
  }
  return q;
}

class Random {
 public:
  float operator()(float low, float high) { return low + (high - low) * static_cast<float>(engine_() >> 8) * 0x1p-24F; }

 private:
  std::mt19937 engine_{11};
};

/// Crowded, so that many sums have many terms.
std::vector<ViewSphere> spheres() {
  Random random;
  std::vector<ViewSphere> all(kCount);
  for (ViewSphere& s : all) s = {random(-1.5F, 1.5F), random(-1.2F, 1.2F), random(1.5F, 3), random(0.02F, 0.15F)};
  return all;
}

std::vector<ViewEllipsoid> ellipsoids() {
  Random random;
  std::vector<ViewEllipsoid> all;
  for (const ViewSphere& s : spheres()) {
    const float xx = random(0.5F, 1) * s.radius * s.radius;
    const float yy = random(0.5F, 1) * s.radius * s.radius;
    all.push_back({s.x, s.y, s.z, 0.5F * s.radius, xx, yy, s.radius * s.radius, 0.2F * xx, 0, 0});
  }
  return all;
}

/// Compares what `draw` gives for every number of threads; at least a twentieth of it is not 0.
template <class Draw>
void expectSameBits(const char* what, const Draw& draw) {
  const int usual = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<float> one = draw();
  for (const int threads : {2, 4}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(one, draw()) << what << ", " << threads << " threads";
  }
  omp_set_num_threads(usual);
  const auto empty = static_cast<std::size_t>(std::ranges::count(one, 0.0F));
  EXPECT_LT(empty, one.size() - one.size() / 20) << what;
}

TEST(ThreadCount, DoesNotChangeSplats) {
  const std::vector<ViewSphere> balls = spheres();
  const std::vector<ViewEllipsoid> stretched = ellipsoids();
  const auto drawn = [](const auto& draw) {
    return [draw] {
      SplatRaster raster;
      std::vector<float> result = picture();
      draw(raster, result);
      return result;
    };
  };
  using Floats = std::vector<float>;
  constexpr float kVolume = 1e-4F;
  for (const float rim : {0.0F, kRimDepth}) {
    expectSameBits("spheres", drawn([&](SplatRaster& r, Floats& q) { r.drawDepth(balls, kView, rim, q); }));
    expectSameBits("ellipsoids", drawn([&](SplatRaster& r, Floats& q) { r.drawDepth(stretched, kView, rim, q); }));
    expectSameBits("backs of spheres",
                   drawn([&](SplatRaster& r, Floats& z) { r.drawBackDepth(balls, kView, rim, z); }));
    expectSameBits("backs of ellipsoids",
                   drawn([&](SplatRaster& r, Floats& z) { r.drawBackDepth(stretched, kView, rim, z); }));
  }
  expectSameBits("discs", drawn([&](SplatRaster& r, Floats& q) { r.drawDiscDepth(balls, kView, q); }));
  expectSameBits("backs of discs", drawn([&](SplatRaster& r, Floats& z) { r.drawDiscBackDepth(balls, kView, z); }));
  expectSameBits("thickness of spheres",
                 drawn([&](SplatRaster& r, Floats& t) { r.drawThickness(balls, kView, kVolume, t); }));
  expectSameBits("thickness of ellipsoids",
                 drawn([&](SplatRaster& r, Floats& t) { r.drawThickness(stretched, kView, kVolume, t); }));
}

TEST(ThreadCount, DoesNotChangeNoise) {
  core::ParticleSnapshot particles;
  particles.spacing = 0.06;
  Random random;
  std::vector<float> violence;
  SplatSelection all;
  for (std::size_t i = 0; i < kCount; ++i) {
    particles.positions.emplace_back(random(-1.5F, 1.5F), random(-1.2F, 1.2F), -random(1.8F, 2.2F));
    particles.ids.push_back(static_cast<std::uint32_t>(i));
    violence.push_back(random(0, 1));
    all.points.particles.push_back(static_cast<std::uint32_t>(i));
  }
  v1::Noise settings;
  const std::vector<float> q = surface();
  const auto draw = [&] {
    const std::vector<NoiseSprite> sprites = makeNoiseSprites(particles, all, violence, settings, kView, 0.01F);
    std::vector<float> both = picture();
    std::vector<float> violent = picture();
    NoiseRaster().draw(sprites, kView, 0.06F, q, both, violent);
    both.insert(both.end(), violent.begin(), violent.end());
    return both;
  };
  expectSameBits("noise and violence", draw);
}

TEST(ThreadCount, DoesNotChangeFoam) {
  v1::Scene scene;
  scene.mutable_foam();
  scene::complete(scene);
  core::DiffuseParticles foam;
  Random random;
  for (std::size_t i = 0; i < kCount; ++i) {
    foam.positions.emplace_back(random(-1.5F, 1.5F), random(-1.2F, 1.2F), -random(1.5F, 2.1F));
    foam.velocities.emplace_back(Eigen::Vector3f::Zero());
    foam.kinds.push_back(static_cast<core::DiffuseKind>(i % 3));
    foam.remaining.push_back(random(0.1F, 1));
    foam.ids.push_back(static_cast<std::uint32_t>(i));
  }
  constexpr double kSpacing = 0.2;
  const std::vector<float> q = surface();
  const FoamCover cover{q, kView};
  expectSameBits("foam", [&] {
    std::vector<float> depth = picture();
    drawFoam(makeFoamDots(foam, scene, kSpacing, kView), kView, {{&cover, 1}, foamBed(scene, kSpacing)}, depth);
    return depth;
  });
}

TEST(ThreadCount, DoesNotChangeValuesAtTheSurface) {
  std::vector<ViewValue> values;
  Random random;
  for (const ViewSphere& s : spheres()) values.push_back({s.x, s.y, s.z, random(-1, 1)});
  const std::vector<float> q = surface();
  expectSameBits("values", [&] {
    std::vector<float> result = picture();
    AttributeRaster().draw(values, 0.06F, q, kView, kView, result);
    return result;
  });
}

TEST(ThreadCount, DoesNotChangeSmoothing) {
  const std::vector<float> q = surface();
  Random random;
  std::vector<float> rough = q;
  for (float& value : rough) value *= random(0.1F, 0.3F);
  expectSameBits("thickness", [&] {
    std::vector<float> thickness = rough;
    ThicknessSmoothing().smooth(thickness, kView, q, kView, 0.04F);
    return thickness;
  });
  expectSameBits("implicit flow", [&] {
    std::vector<float> depths = q;
    ImplicitCurvatureFlow().smooth(depths, kView.size,
                                   {.pixelSlope = kView.pixelSlope, .time = 0.01F, .edge = 0.2F, .widestGap = 0.05F});
    return depths;
  });
  for (const int stages : {1, 5}) {
    expectSameBits("explicit flow", [&] {
      std::vector<float> depths = q;
      ExplicitFlow().run(depths, kView.size, {.pixelSlope = kView.pixelSlope, .edge = 0.2F},
                         {.iterations = 10, .stages = stages, .stepTime = 1e-5});
      return depths;
    });
  }
  expectSameBits("lines", [&] {
    std::vector<float> cells = rough;
    smoothLines(cells, kView.size.width, {.sweeps = 5, .limit = 0.05F, .outside = 0});
    return cells;
  });
}

}  // namespace
}  // namespace sluice::render
