#include "wall_contact.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sluice::sim {
namespace {

TEST(WallContact, MirrorsWhereDensityIsThatAtRest) {
  EXPECT_EQ(wallMirror(0.7F), 2);
  EXPECT_EQ(wallMirror(1.001F), 2);
  EXPECT_EQ(wallMirror(1.1F), 1);
  EXPECT_GT(wallMirror(1.01F), wallMirror(1.015F));
}

// N of a flat wall below: a quarter along it.
TEST(WallContact, MakesUpForTheWallsShareAlongItAndNotAcross) {
  const WallSums floor{.gradient = {0, 8, 0, 0}, .xx = 0.25F, .yy = 0.5F, .zz = 0.25F};
  const WallContact contact = wallContact(7, floor, 2);
  EXPECT_EQ(contact.particle, 7U);
  const Float4 along = contact.surplus({3, 0, 0, 0});
  EXPECT_NEAR(along.x, 3 * (1 / 0.75 - 1), 1e-5);
  EXPECT_NEAR(along.y, 0, 1e-5);
  const Float4 across = contact.surplus({0, 3, 0, 0});
  EXPECT_NEAR(across.x, 0, 1e-5);
  EXPECT_NEAR(across.y, 0, 1e-5);
}

TEST(WallContact, KeepsTheAxesOfTheShare) {
  // Shares of 0.5 and 0.2 along axes turned by 30 degrees in a wall across z.
  const float c = std::cos(0.5236F);
  const float s = std::sin(0.5236F);
  const WallSums wall{.gradient = {0, 0, -5, 0},
                      .xx = 0.5F * c * c + 0.2F * s * s,
                      .yy = 0.5F * s * s + 0.2F * c * c,
                      .zz = 0.4F,
                      .xy = 0.3F * c * s};
  const WallContact contact = wallContact(0, wall, 2);
  const Float4 first = contact.surplus({c, s, 0, 0});
  EXPECT_NEAR(first.x, c, 1e-4);
  EXPECT_NEAR(first.y, s, 1e-4);
  const Float4 second = contact.surplus({-s, c, 0, 0});
  EXPECT_NEAR(second.x, -0.25 * s, 1e-4);
  EXPECT_NEAR(second.y, 0.25 * c, 1e-4);
}

TEST(WallContact, IsOfNoConsequenceWhereTheWallAnswersOnce) {
  const WallSums floor{.gradient = {0, 8, 0, 0}, .xx = 0.25F, .yy = 0.5F, .zz = 0.25F};
  const Float4 surplus = wallContact(0, floor, 1).surplus({1, 1, 1, 0});
  EXPECT_EQ(surplus.x, 0);
  EXPECT_EQ(surplus.y, 0);
  EXPECT_EQ(surplus.z, 0);
}

}  // namespace
}  // namespace sluice::sim
