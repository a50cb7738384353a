// Every kind of environment: pictures show what the CPU computes, and matte things get its light.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <Eigen/Geometry>

#include "environment.h"
#include "render_test.h"

namespace sluice::testing {
namespace {

using Eigen::Vector3f;

class Environment : public RenderTest {
 protected:
  Environment() {
    background.set_floor(false);
    particles = cloud({}, 0.05);
  }

  render::RadiancePicture draw(const core::Camera& camera) {
    render(particles, camera, size);
    return renderer.readRadiance();
  }

  /// Compares every pixel with `radiance` in its direction.
  template <class Radiance>
  void expectShows(const Radiance& radiance, float tolerance) {
    for (const Vector3f& target : {Vector3f(0, 0.3F, -1), Vector3f(1, -0.2F, 0.1F), Vector3f(-0.3F, 1, 1)}) {
      const core::Camera camera{{0, 1, 0}, Vector3f(0, 1, 0) + target, {0, 1, 0}, 70.0F};
      const render::RadiancePicture picture = draw(camera);
      const render::ViewGeometry view = render::makeViewGeometry(camera, size);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const float w =
              (2.0F * (static_cast<float>(x) + 0.5F) / static_cast<float>(size.width) - 1.0F) * view.maxSlope.x();
          const float h =
              (2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(size.height) - 1.0F) * view.maxSlope.y();
          const Vector3f direction = (view.forward + w * view.right + h * view.down).normalized();
          const Vector3f expected = radiance(direction);
          for (int c = 0; c < 3; ++c) {
            const float shown = picture.values[static_cast<std::size_t>(4 * (y * size.width + x) + c)];
            ASSERT_NEAR(shown, expected[c], tolerance * (1.0F + expected[c])) << x << " " << y;
          }
        }
      }
    }
  }

  core::ParticleSnapshot particles;
  core::ImageSize size{48, 36};
};

TEST_F(Environment, SkyIsSeenAsItIsComputed) {
  // The disc is only in pictures; from below the horizon there is none. The picture of all directions has texels of a
  // third of a degree.
  sun.mutable_direction()->set_y(-0.4);
  expectShows([&](const Vector3f& d) { return render::skyRadiance(d, background.sky(), sun); }, 2e-2F);
}

TEST_F(Environment, EveryDirectionHasItsPlaceInThePicture) {
  for (int v = 0; v < 16; ++v) {
    for (int u = 0; u < 16; ++u) {
      const auto place = [](int i) { return (static_cast<float>(i) + 0.5F) / 16.0F; };
      const Vector3f d = render::directionAt(place(u), place(v));
      EXPECT_NEAR(d.norm(), 1, 1e-5F);
      // As octahedral() in shaders/environment.glsl.
      Eigen::Vector2f p = Eigen::Vector2f(d.x(), d.z()) / d.lpNorm<1>();
      if (d.y() < 0) {
        p = {std::copysign(1 - std::abs(p.y()), p.x()), std::copysign(1 - std::abs(p.x()), p.y())};
      }
      EXPECT_NEAR(0.5F + 0.5F * p.x(), place(u), 1e-5F);
      EXPECT_NEAR(0.5F + 0.5F * p.y(), place(v), 1e-5F);
    }
  }
}

TEST_F(Environment, SunStandsInTheSkyWhereItShinesFrom) {
  const Vector3f towards = render::sunDirection(sun);
  const render::RadiancePicture picture = draw({{0, 1, 0}, Vector3f(0, 1, 0) + towards, {0, 1, 0}, 10.0F});
  const auto at = [&](int x, int y) { return picture.values[static_cast<std::size_t>(4 * (y * size.width + x))]; };
  EXPECT_GT(at(24, 18), 10.0F);
  EXPECT_LT(at(2, 2), 3.0F);
}

/// 64x32: bright at the top, a red patch in the middle.
imageio::LinearImage studio() {
  imageio::LinearImage map{{64, 32}, {}};
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool patch = std::abs(x - 32) < 6 && std::abs(y - 16) < 4;
      const float light = y < 8 ? 4.0F : 0.5F;
      map.values.insert(map.values.end(), {patch ? 2.0F : light, patch ? 0.25F : light, patch ? 0.125F : light});
    }
  }
  return map;
}

/// Writes flat RGBE; all values of studio() are exact in it.
std::string writeHdr(const imageio::LinearImage& map) {
  const std::string path = (std::filesystem::temp_directory_path() / "sluice_environment_test.hdr").string();
  std::ofstream out(path, std::ios::binary);
  out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " << map.size.height << " +X " << map.size.width << "\n";
  for (std::size_t i = 0; i < map.values.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) out.put(static_cast<char>(std::lround(map.values[i + c] * 32)));
    out.put(static_cast<char>(131));  // 2^(131-136) = 1/32
  }
  return path;
}

TEST_F(Environment, MapIsSeenWhereItsDirectionsAre) {
  const imageio::LinearImage map = studio();
  v1::EnvironmentMap& given = *background.mutable_environment_map();
  given.set_path(writeHdr(map));
  given.set_strength(0.5);
  given.set_turn_degrees(40);
  scene::complete(scene);
  background.set_floor(false);
  // Where the map is even: along its edges the picture of all directions blurs it by a texel or two.
  const Vector3f patch =
      Eigen::AngleAxisf(40.0F * std::numbers::pi_v<float> / 180.0F, Vector3f::UnitY()) * -Vector3f::UnitZ();
  for (const auto& [d, expected] : {std::pair(Vector3f(patch), Vector3f(1.0F, 0.125F, 0.0625F)),
                                    std::pair(Vector3f(0, 1, 0.01F), Vector3f(2, 2, 2)),
                                    std::pair(Vector3f(-patch - Vector3f(0, 1, 0)), Vector3f(0.25F, 0.25F, 0.25F))}) {
    EXPECT_LT((0.5F * render::mapRadiance(map, d.normalized(), 40.0F / 360.0F) - expected).norm(), 1e-2F);
    const render::RadiancePicture picture = draw({{0, 1, 0}, Vector3f(0, 1, 0) + d, {0, 1, 0.1F}, 3.0F});
    const std::size_t middle = 4 * static_cast<std::size_t>(size.height / 2 * size.width + size.width / 2);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(picture.values[middle + c], expected[static_cast<int>(c)], 1e-2F);
  }
  std::filesystem::remove(given.path());
}

/// Everything white around: what is lossless neither adds nor takes.
class WhiteFurnace : public Environment, public ::testing::WithParamInterface<std::string> {};

TEST_P(WhiteFurnace, StaysWhite) {
  background.mutable_uniform();
  sun.set_strength(0);
  v1::Liquid& liquid = *look.mutable_liquid();
  liquid.GetReflection()->MutableMessage(&liquid, v1::Liquid::descriptor()->FindFieldByName(GetParam()));
  for (v1::Vec3* const none : {liquid.mutable_absorption(), liquid.mutable_scatter_colour()}) {
    none->set_x(0);
    none->set_y(0);
    none->set_z(0);
  }
  scene::complete(scene);
  background.set_floor(false);
  for (const core::ParticleSnapshot& drawn : {cloud({}, 0.05), slab(2.0F, 0.5F, 0.05F, 0.6F), columnAndSheet(4000)}) {
    particles = drawn;
    for (const core::Camera& camera : {alongZ(), columnAndSheetCamera()}) {
      const render::RadiancePicture picture = draw(camera);
      for (std::size_t i = 0; i < picture.values.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(picture.values[i + c], 1.0F, 0.01F) << i / 4;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Refractions, WhiteFurnace, ::testing::Values("snell", "screen_shift", "two_interfaces"),
                         [](const auto& refraction) { return refraction.param; });

TEST_F(Environment, WhatIsNotMirroredIsLeftOut) {
  particles = slab(2.0F, 0.5F, 0.05F);
  const auto leavesOutReflection = [&] {
    render(particles, alongZ(), size);
    return std::ranges::count(renderer.plan().leftOut, "reflection", &core::LeftOut::name) == 1;
  };
  EXPECT_FALSE(leavesOutReflection());
  look.mutable_liquid()->mutable_no_reflection();
  EXPECT_TRUE(leavesOutReflection());
  look.mutable_liquid()->mutable_surroundings();
  background.mutable_backdrop();
  scene::complete(scene);
  EXPECT_TRUE(leavesOutReflection());
}

TEST(AmbientLight, IsTheCosineWeightedMeanOfTheSky) {
  v1::Scene scene;
  scene::complete(scene);
  const auto sky = [&](const Vector3f& d) {
    return render::skyRadiance(d, scene.background().sky(), scene.lighting().sun());
  };
  const render::AmbientLight ambient(sky);
  for (const Vector3f& n : {Vector3f(0, 1, 0), Vector3f(0, -1, 0), Vector3f(1, 0, 0), Vector3f(0.6F, 0.64F, -0.48F)}) {
    Vector3f sum = Vector3f::Zero();
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / kSteps;
      for (int j = 0; j < kSteps; ++j) {
        const float turn = 2 * std::numbers::pi_v<float> * (static_cast<float>(j) + 0.5F) / kSteps;
        const float ring = std::sqrt(1 - y * y);
        const Vector3f d(ring * std::cos(turn), y, ring * std::sin(turn));
        sum += std::max(d.dot(n), 0.0F) * sky(d);
      }
    }
    const Vector3f expected = 4.0F / (kSteps * kSteps) * sum;
    // Degrees beyond 2 hold at most a few percent of irradiance (Ramamoorthi & Hanrahan: 1 % on average, 9 % at worst).
    EXPECT_LT((ambient.at(n) - expected).norm(), 0.06F * expected.norm()) << n.transpose();
  }
  const render::AmbientLight white([](const Vector3f&) { return Vector3f::Ones(); });
  EXPECT_LT((white.at({0, 0.6F, 0.8F}) - Vector3f::Ones()).norm(), 1e-3F);
}

}  // namespace
}  // namespace sluice::testing
