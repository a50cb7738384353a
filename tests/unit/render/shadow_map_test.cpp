#include "shadow_map.h"

#include <gtest/gtest.h>

#include <numeric>

#include "column_and_sheet.h"

namespace sluice::render {
namespace {

const Eigen::Vector3f kSun = Eigen::Vector3f(0.45F, 0.75F, 0.35F).normalized();

TEST(ShadowMap, HoldsTheVolumeThatCastsIt) {
  const core::ParticleSnapshot particles = testing::columnAndSheet(8000);
  const auto spacing = static_cast<float>(particles.spacing);
  const ShadowMap map = castShadow(particles.positions, spacing, 0.0F, kSun);
  const float cell = map.edge / static_cast<float>(ShadowMap::kEdge);
  const double sum = std::accumulate(map.thickness.begin(), map.thickness.end(), 0.0);
  // A beam of floor area A is A·rise wide.
  std::size_t above = 0;
  for (const Eigen::Vector3f& p : particles.positions) above += p.y() >= 0.0F ? 1 : 0;
  const double volume = static_cast<double>(above) * spacing * spacing * spacing;
  EXPECT_NEAR(sum * cell * cell * kSun.y(), volume, 1e-3 * volume);
}

TEST(ShadowMap, FallsAwayFromTheSun) {
  const std::vector<Eigen::Vector3f> ball(10, Eigen::Vector3f(0.0F, 2.0F, 0.0F));
  const ShadowMap map = castShadow(ball, 0.1F, 1.0F, kSun);
  const Eigen::Vector2f centre = map.corner + Eigen::Vector2f::Constant(0.5F * map.edge);
  EXPECT_NEAR(centre.x(), -0.45F / 0.75F, 1e-5F);
  EXPECT_NEAR(centre.y(), -0.35F / 0.75F, 1e-5F);
}

TEST(ShadowMap, NeedsSunAndLiquidAboveTheFloor) {
  const std::vector<Eigen::Vector3f> below{{0.0F, -1.0F, 0.0F}};
  EXPECT_EQ(castShadow(below, 0.1F, 0.0F, kSun).edge, 0.0F);
  EXPECT_EQ(castShadow({}, 0.1F, 0.0F, kSun).edge, 0.0F);
  EXPECT_EQ(castShadow(below, 0.1F, -2.0F, {1.0F, 0.0F, 0.0F}).edge, 0.0F);
}

}  // namespace
}  // namespace sluice::render
