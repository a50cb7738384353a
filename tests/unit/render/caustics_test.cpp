#include "caustics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sluice::render {
namespace {

constexpr float kCell = 0.01F;
constexpr float kIndex = 1.333F;
constexpr float kLimit = 0.08F;

/// A surface of a function of light space's x and y over the middle of a grid, seen by a sun overhead.
class Surface {
 public:
  template <class Depth>
  Surface(float halfWidth, const Eigen::Vector3f& sun, const Depth& depth)
      : grid(coverWithCells(lightAxes(sun), square(halfWidth), 0.3F, kCell)), front(grid.cells(), kNoLiquid) {
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const Eigen::Vector2f place =
            grid.corner + grid.cell * Eigen::Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        if (place.cwiseAbs().maxCoeff() < halfWidth) front[index(x, y)] = depth(place);
      }
    }
  }

  std::vector<float> focus(float floorHeight, float refractiveIndex = kIndex, std::span<const float> receiver = {}) {
    const std::vector<float> inverse(grid.cells(), 1.0F / refractiveIndex);
    const std::span<const float> result = caustics.focus({front, inverse, receiver, kLimit, floorHeight}, grid);
    return {result.begin(), result.end()};
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
  }

  static Eigen::AlignedBox2f square(float half) {
    return {Eigen::Vector2f::Constant(-half), Eigen::Vector2f::Constant(half)};
  }

  LightGrid grid;
  std::vector<float> front;
  Caustics caustics;
};

const Eigen::Vector3f kOverhead = Eigen::Vector3f::UnitY();

double sum(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

float brightest(const std::vector<float>& values) { return *std::ranges::max_element(values); }

/// Waves 1 cm high, 20 cm long, on water 40 cm above the floor: depth along the light is −height.
float waves(const Eigen::Vector2f& place) { return -0.4F - 0.01F * std::sin(31.4F * place.x()); }

TEST(Caustics, LightIsNeitherLostNorWon) {
  Surface surface(0.5F, kOverhead, waves);
  const std::vector<float> focus = surface.focus(0.0F);
  EXPECT_NEAR(sum(focus) / static_cast<double>(focus.size()), 1.0, 1e-5);
  EXPECT_GE(*std::ranges::min_element(focus), 0.0F);
}

TEST(Caustics, WavesDrawBrightFilaments) {
  Surface surface(0.5F, kOverhead, waves);
  const std::vector<float> focus = surface.focus(0.0F);
  // Crests gather: h·(1 − 1/n)·A·k² is close to 1, a focus.
  EXPECT_GT(brightest(focus), 3.0F);
}

TEST(Caustics, FlatSurfaceFocusesNothing) {
  const Eigen::Vector3f sun = Eigen::Vector3f(0.45F, 0.75F, 0.35F).normalized();
  // Level: the plane y = 0.3 as the sun sees it.
  const LightAxes axes = lightAxes(sun);
  Surface surface(0.5F, sun, [&](const Eigen::Vector2f& place) { return axes.depthOfFloor(place.y(), 0.3F); });
  const std::vector<float> focus = surface.focus(0.0F);
  const int width = 2 * surface.grid.width;
  const int height = 2 * surface.grid.height;
  for (int y = 4 * height / 9; y < 5 * height / 9; ++y) {
    for (int x = 4 * width / 9; x < 5 * width / 9; ++x) {
      EXPECT_NEAR(focus[static_cast<std::size_t>(y * width + x)], 1.0F, 0.01F);
    }
  }
}

TEST(Caustics, FlatSurfaceShiftsLightAsSnellSays) {
  const Eigen::Vector3f sun = Eigen::Vector3f(1.0F, 1.0F, 0.0F).normalized();
  const LightAxes axes = lightAxes(sun);
  const float depth = 0.3F;
  Surface surface(0.2F, sun, [&](const Eigen::Vector2f& place) { return axes.depthOfFloor(place.y(), depth); });
  const std::vector<float> focus = surface.focus(0.0F);
  // On the floor h·(tanθi − tanθt) towards the sun; cosθi of that across the light.
  const float sine = std::sqrt(0.5F) / kIndex;
  const float shift = depth * (1.0F - sine / std::sqrt(1.0F - sine * sine)) * std::sqrt(0.5F);
  // The light's centre of gravity moves by that for the share of the flux that passes the liquid.
  double moment = 0;
  double passed = 0;
  const int width = 2 * surface.grid.width;
  for (std::size_t i = 0; i < focus.size(); ++i) {
    moment += (focus[i] - 1.0) * 0.5 * surface.grid.cell * static_cast<double>(static_cast<int>(i) / width);
  }
  for (const float depthHere : surface.front) passed += depthHere < kNoLiquid ? 4 : 0;
  EXPECT_NEAR(std::abs(moment) / passed, shift, 0.01 * shift);
}

TEST(Caustics, DropIsALens) {
  // A ball of radius 15 cm whose front stands 40 cm above the floor.
  const float radius = 0.15F;
  Surface surface(0.5F, kOverhead, [&](const Eigen::Vector2f& place) {
    const float room = radius * radius - place.squaredNorm();
    return room > 0.0F ? -0.25F - std::sqrt(room) : kNoLiquid;
  });
  const std::vector<float> focus = surface.focus(0.0F);
  const int width = 2 * surface.grid.width;
  const int height = 2 * surface.grid.height;
  const auto peak = std::ranges::max_element(focus) - focus.begin();
  EXPECT_GT(focus[static_cast<std::size_t>(peak)], 5.0F);
  EXPECT_NEAR(static_cast<float>(peak % width) + 0.5F, 0.5F * static_cast<float>(width), 3.0F);
  EXPECT_NEAR(static_cast<float>(peak / width) + 0.5F, 0.5F * static_cast<float>(height), 3.0F);
  EXPECT_NEAR(sum(focus) / static_cast<double>(focus.size()), 1.0, 1e-4);
}

TEST(Caustics, WithoutRefractionLightIsAsItWas) {
  Surface surface(0.5F, kOverhead, waves);
  for (const float value : surface.focus(0.0F, 1.0F)) EXPECT_NEAR(value, 1.0F, 1e-3F);
}

TEST(Caustics, NearerReceiversSeeLessFocus) {
  Surface surface(0.5F, kOverhead, waves);
  const float far = brightest(surface.focus(0.0F));
  const std::vector<float> receiver(surface.grid.cells(), -0.3F);
  const float near = brightest(surface.focus(0.0F, kIndex, receiver));
  EXPECT_LT(near, 0.7F * far);
  EXPECT_GT(near, 1.1F);
}

}  // namespace
}  // namespace sluice::render
