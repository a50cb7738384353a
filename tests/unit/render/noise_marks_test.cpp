// Which particles count as violent, over a run of snapshots.
#include "noise_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace sluice::render {
namespace {

v1::Noise settings(double threshold = 30, double coolDown = 0.5) {
  v1::Noise noise;
  noise.set_acceleration_threshold(threshold);
  noise.set_cool_down_seconds(coolDown);
  return noise;
}

core::ParticleSnapshot at(double time, std::vector<std::uint32_t> ids, std::vector<Eigen::Vector3f> velocities) {
  core::ParticleSnapshot snapshot;
  snapshot.time = time;
  snapshot.positions.resize(ids.size(), Eigen::Vector3f::Zero());
  snapshot.ids = std::move(ids);
  snapshot.velocities = std::move(velocities);
  return snapshot;
}

/// The same particles in another order.
core::ParticleSnapshot shuffled(const core::ParticleSnapshot& given, std::uint32_t seed,
                                std::vector<std::size_t>& order) {
  order.resize(given.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  core::ParticleSnapshot other = given;
  for (std::size_t i = 0; i < order.size(); ++i) {
    other.ids[i] = given.ids[order[i]];
    other.velocities[i] = given.velocities[order[i]];
  }
  return other;
}

TEST(NoiseMarks, AreOneAboveTheThresholdAndThenFallExponentially) {
  NoiseMarks marks;
  marks.follow(at(1.0, {4, 9}, {{0, 0, 0}, {0, 0, 0}}), settings());
  EXPECT_EQ(marks.violence()[0], 0.0F);
  // 40 and 20 m/s².
  marks.follow(at(1.1, {4, 9}, {{0, 4, 0}, {2, 0, 0}}), settings());
  EXPECT_EQ(marks.violence()[0], 1.0F);
  EXPECT_EQ(marks.violence()[1], 0.0F);
  marks.follow(at(1.3, {4, 9}, {{0, 4, 0}, {2, 0, 0}}), settings());
  EXPECT_NEAR(marks.violence()[0], std::exp(-0.2F / 0.5F), 1e-6F);
}

TEST(NoiseMarks, DoNotDependOnThePaceOfTheSnapshots) {
  // 50 m/s² for 0.1 s, then rest, seen 100 and 400 times a second.
  const auto velocity = [](double t) { return Eigen::Vector3f(static_cast<float>(50 * std::min(t, 0.1)), 0, 0); };
  float expected = 0;
  for (const int pace : {100, 400}) {
    NoiseMarks marks;
    for (int k = 0; k <= pace * 3 / 10; ++k) {
      const double t = static_cast<double>(k) / pace;
      marks.follow(at(t, {7}, {velocity(t)}), settings());
    }
    if (expected > 0) {
      EXPECT_NEAR(marks.violence()[0], expected, 0.02F);
    }
    expected = marks.violence()[0];
    EXPECT_GT(expected, 0.5F);
  }
}

TEST(NoiseMarks, FollowIdsWhateverTheOrder) {
  std::mt19937 random(3);
  std::normal_distribution<float> speed(0, 3);
  std::vector<std::uint32_t> ids(500);
  // Neither from 0 nor without gaps, and with many that share a slot.
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::uint32_t>(100 + (i % 7) * 4096 + i);
  NoiseMarks straight;
  NoiseMarks mixed;
  std::size_t violent = 0;
  for (int k = 0; k < 5; ++k) {
    std::vector<Eigen::Vector3f> velocities(ids.size());
    for (Eigen::Vector3f& v : velocities) v = {speed(random), speed(random), speed(random)};
    const core::ParticleSnapshot given = at(0.1 * k, ids, velocities);
    std::vector<std::size_t> order;
    const core::ParticleSnapshot other = shuffled(given, static_cast<std::uint32_t>(k), order);
    straight.follow(given, settings(50));
    mixed.follow(other, settings(50));
    for (std::size_t i = 0; i < order.size(); ++i) {
      ASSERT_EQ(mixed.violence()[i], straight.violence()[order[i]]) << k;
      violent += straight.violence()[i] == 1.0F ? 1 : 0;
    }
  }
  EXPECT_GT(violent, 100U);
  EXPECT_LT(violent, 4 * ids.size() - 100);
}

TEST(NoiseMarks, NewParticlesAreCalm) {
  NoiseMarks marks;
  marks.follow(at(0, {1}, {{0, 0, 0}}), settings());
  marks.follow(at(0.1, {2, 1, 4000000000U}, {{9, 0, 0}, {9, 0, 0}, {9, 0, 0}}), settings());
  EXPECT_EQ(marks.violence()[0], 0.0F);
  EXPECT_EQ(marks.violence()[1], 1.0F);
  EXPECT_EQ(marks.violence()[2], 0.0F);
}

TEST(NoiseMarks, AreForgottenWhenTimeGoesBack) {
  NoiseMarks marks;
  marks.follow(at(1.0, {1}, {{0, 0, 0}}), settings());
  marks.follow(at(1.1, {1}, {{9, 0, 0}}), settings());
  ASSERT_EQ(marks.violence()[0], 1.0F);
  marks.follow(at(0.0, {1}, {{0, 0, 0}}), settings());
  EXPECT_EQ(marks.violence()[0], 0.0F);
}

TEST(NoiseMarks, StayWhereTimeStands) {
  NoiseMarks marks;
  marks.follow(at(1.0, {1, 2}, {{0, 0, 0}, {0, 0, 0}}), settings());
  marks.follow(at(1.1, {1, 2}, {{9, 0, 0}, {0, 0, 0}}), settings());
  marks.follow(at(1.1, {2, 1}, {{0, 0, 0}, {9, 0, 0}}), settings());
  EXPECT_EQ(marks.violence()[0], 0.0F);
  EXPECT_EQ(marks.violence()[1], 1.0F);
}

TEST(NoiseMarks, AreNoneWithoutIdsOrVelocities) {
  NoiseMarks marks;
  marks.follow(at(0, {1}, {{0, 0, 0}}), settings());
  core::ParticleSnapshot without = at(0.1, {1}, {{9, 0, 0}});
  without.velocities.clear();
  marks.follow(without, settings());
  EXPECT_TRUE(marks.violence().empty());
  without = at(0.2, {1}, {{9, 0, 0}});
  without.ids.clear();
  marks.follow(without, settings());
  EXPECT_TRUE(marks.violence().empty());
  // And begins anew, calm, with the next that has both.
  marks.follow(at(0.3, {1}, {{90, 0, 0}}), settings());
  EXPECT_EQ(marks.violence()[0], 0.0F);
}

}  // namespace
}  // namespace sluice::render
