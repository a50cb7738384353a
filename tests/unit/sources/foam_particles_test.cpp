#include "foam_particles.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "foam_support.h"

namespace sluice::sources::test {
namespace {

using core::DiffuseKind;
using Eigen::Vector3f;

/// A cube at rest, and particles that are moved beside it.
class FoamMotion : public testing::Test {
 protected:
  FoamMotion() : grid_(cube_.grid()), scales_(foamScales(cube_.positions.size(), cube_.spacing, 9.81)) {}

  void advance(float seconds, int steps, const FoamWalls& walls = {}) {
    for (int i = 0; i < steps; ++i) particles_.advance(grid_, walls, scales_, life_, seconds, 1);
  }

  DiffuseKind kindAt(const Vector3f& place, const FoamWalls& walls = {}) {
    FoamParticles one;
    one.add(place, Vector3f::Zero(), DiffuseKind::Foam, 1);
    one.advance(grid_, walls, scales_, life_, 1e-5F, 1);
    return one.all().kinds.at(0);
  }

  Cube cube_{10, atRest};
  LiquidGrid grid_;
  FoamScales scales_;
  FoamLife life_;
  FoamParticles particles_;
};

TEST_F(FoamMotion, OfSprayIsBallistic) {
  const Vector3f start(0.5F, 1.5F, 0.5F);
  const Vector3f velocity(1, 2, -0.5F);
  particles_.add(start, velocity, DiffuseKind::Spray, 1);
  advance(0.02F, 10);
  const float t = 0.2F;
  const Vector3f expected = start + t * velocity + 0.5F * t * t * life_.gravity;
  ASSERT_EQ(particles_.all().size(), 1U);
  EXPECT_LT((particles_.all().positions[0] - expected).norm(), 1e-5F);
  EXPECT_LT((particles_.all().velocities[0] - (velocity + t * life_.gravity)).norm(), 1e-5F);
}

TEST_F(FoamMotion, OfBubblesGoesUpAtASpeedThatTheStepDoesNotChange) {
  for (const int steps : {1, 20}) {
    particles_.clear();
    particles_.add({0.5F, 0.4F, 0.5F}, Vector3f::Zero(), DiffuseKind::Bubble, 1);
    advance(0.2F / static_cast<float>(steps), steps);
    // k_b·g over the rate of drag, -ln(1 - k_d)/(1/50 s).
    EXPECT_NEAR(particles_.all().velocities.at(0).y(), 2 * 9.81 * 0.02 / -std::log(0.2), 1e-3) << steps;
  }
}

TEST_F(FoamMotion, OfBubblesUnderAnyDragIsFinite) {
  for (const float drag : {0.0F, 1e-7F, 0.5F, 1.0F}) {
    life_.drag = drag;
    particles_.clear();
    particles_.add({0.5F, 0.4F, 0.5F}, Vector3f::Zero(), DiffuseKind::Bubble, 1);
    advance(0.01F, 1);
    EXPECT_TRUE(particles_.all().positions.at(0).allFinite()) << drag;
    EXPECT_GE(particles_.all().velocities.at(0).y(), 0) << drag;
  }
}

TEST_F(FoamMotion, OfFoamIsThatOfTheLiquid) {
  cube_ = Cube(10, [](const Vector3f&) { return Vector3f(1, 0, 0); });
  grid_ = cube_.grid();
  particles_.add({0.5F, 1, 0.5F}, Vector3f::Zero(), DiffuseKind::Foam, 1);
  advance(0.01F, 1);
  EXPECT_NEAR(particles_.all().velocities.at(0).x(), 1, 1e-5);
  EXPECT_NEAR(particles_.all().positions.at(0).x(), 0.51, 1e-5);
}

TEST_F(FoamMotion, FollowsTheNumberOfNeighbours) {
  EXPECT_EQ(kindAt({0.5F, 0.5F, 0.5F}), DiffuseKind::Bubble);
  EXPECT_EQ(kindAt({0.5F, 1, 0.5F}), DiffuseKind::Foam);
  EXPECT_EQ(kindAt({0.5F, 1.14F, 0.5F}), DiffuseKind::Spray);
  EXPECT_EQ(kindAt({0.5F, 1.9F, 0.5F}), DiffuseKind::Spray);
  EXPECT_EQ(kindOf(5), DiffuseKind::Spray);
  EXPECT_EQ(kindOf(6), DiffuseKind::Foam);
  EXPECT_EQ(kindOf(20), DiffuseKind::Foam);
  EXPECT_EQ(kindOf(21), DiffuseKind::Bubble);
}

TEST_F(FoamMotion, CountsWallsAsLiquid) {
  const FoamWalls walls(Eigen::AlignedBox3f(Vector3f::Zero(), Vector3f(1, 2, 1)));
  const Vector3f corner(0.02F, 0.02F, 0.02F);
  EXPECT_NE(kindAt(corner), DiffuseKind::Bubble);
  EXPECT_EQ(kindAt(corner, walls), DiffuseKind::Bubble);
}

TEST_F(FoamMotion, AgesFoamAlone) {
  life_.lifetime = 0.1F;
  life_.buoyancy = 0;
  particles_.add({0.5F, 1, 0.5F}, Vector3f::Zero(), DiffuseKind::Foam, 1);
  particles_.add({0.5F, 0.5F, 0.5F}, Vector3f::Zero(), DiffuseKind::Bubble, 1);
  particles_.add({0.5F, 1.9F, 0.5F}, Vector3f::Zero(), DiffuseKind::Spray, 1);
  advance(0.01F, 9);
  ASSERT_EQ(particles_.all().size(), 3U);
  EXPECT_NEAR(particles_.all().remaining[0], 0.1, 1e-4);
  EXPECT_EQ(particles_.all().remaining[1], 1);
  EXPECT_EQ(particles_.all().remaining[2], 1);
  advance(0.01F, 2);
  EXPECT_EQ(particles_.all().ids, (std::vector<std::uint32_t>{1, 2})) << "only the foam is gone";
}

TEST_F(FoamMotion, EndsForSprayOnTheGroundAndOutsideTheScene) {
  const FoamWalls walls(Eigen::AlignedBox3f(Vector3f(-2, 0, -2), Vector3f(3, 3, 3)));
  particles_.add({2, 0.01F, 2}, Vector3f(0, -1, 0), DiffuseKind::Spray, 1);
  advance(0.02F, 1, walls);
  EXPECT_EQ(particles_.all().size(), 0U);

  particles_.add({0.5F, -1.9F, 0.5F}, Vector3f(0, -10, 0), DiffuseKind::Spray, 1);
  advance(0.02F, 1);
  EXPECT_EQ(particles_.all().size(), 0U) << "fell out of the scene";
}

TEST_F(FoamMotion, StopsAtWalls) {
  const FoamWalls walls(Eigen::AlignedBox3f(Vector3f(-2, 0, -2), Vector3f(3, 3, 3)));
  particles_.add({2.99F, 2, 0.5F}, Vector3f(5, 0, 1), DiffuseKind::Spray, 1);
  advance(0.02F, 1, walls);
  EXPECT_EQ(particles_.all().positions.at(0).x(), 3);
  EXPECT_EQ(particles_.all().velocities.at(0).x(), 0);
  EXPECT_EQ(particles_.all().velocities.at(0).z(), 1);
}

TEST_F(FoamMotion, StopsAtBodiesHoweverThin) {
  v1::Scene scene;
  v1::Simulation& simulation = *scene.mutable_simulation();
  simulation.set_particle_spacing(0.1);
  const auto set = [](v1::Vec3* v, double x, double y, double z) {
    v->set_x(x);
    v->set_y(y);
    v->set_z(z);
  };
  set(simulation.mutable_container()->mutable_min(), -2, 0, -2);
  set(simulation.mutable_container()->mutable_max(), 3, 3, 3);
  v1::Body& pane = *scene.add_bodies();
  set(pane.mutable_position(), 2, 1.5, 0.5);
  set(pane.mutable_box()->mutable_size(), 0.001, 3, 3);
  pane.mutable_glass();
  const FoamWalls walls(scene);
  particles_.add({1.9F, 2, 0.5F}, Vector3f(20, 0, 1), DiffuseKind::Spray, 1);
  advance(0.02F, 1, walls);
  EXPECT_LT(particles_.all().positions.at(0).x(), 2);
  EXPECT_GT(particles_.all().positions.at(0).x(), 1.98);
  EXPECT_NEAR(particles_.all().velocities.at(0).x(), 0, 1e-5);
  EXPECT_EQ(particles_.all().velocities.at(0).z(), 1);

  pane.set_solid(false);
  particles_.clear();
  particles_.add({1.9F, 2, 0.5F}, Vector3f(20, 0, 1), DiffuseKind::Spray, 1);
  advance(0.02F, 1, FoamWalls(scene));
  EXPECT_GT(particles_.all().positions.at(0).x(), 2.2) << "is only drawn";
}

TEST_F(FoamMotion, OfNothingInNoLiquidIsSafe) {
  LiquidGrid empty;
  empty.build({}, {}, 0.2F, 2);
  particles_.add({0.05F, 0.05F, 0.05F}, Vector3f(1, 0, 0), DiffuseKind::Foam, 1);
  particles_.advance(empty, {}, foamScales(0, 0.1, 9.81), life_, 0.01F, 2);
  ASSERT_EQ(particles_.all().size(), 1U);
  EXPECT_EQ(particles_.all().kinds[0], DiffuseKind::Spray);
  EXPECT_TRUE(particles_.all().positions[0].allFinite());
}

TEST(FoamParticles, OldestFoamGoesFirst) {
  FoamParticles particles;
  particles.add(Vector3f::Zero(), Vector3f::Zero(), DiffuseKind::Spray, 1);
  particles.add(Vector3f::Zero(), Vector3f::Zero(), DiffuseKind::Foam, 0.7F);
  particles.add(Vector3f::Zero(), Vector3f::Zero(), DiffuseKind::Foam, 0.2F);
  particles.add(Vector3f::Zero(), Vector3f::Zero(), DiffuseKind::Bubble, 1);
  particles.keepAtMost(3);
  EXPECT_EQ(particles.all().ids, (std::vector<std::uint32_t>{0, 1, 3}));
  particles.keepAtMost(2);
  EXPECT_EQ(particles.all().ids, (std::vector<std::uint32_t>{0, 3}));
  particles.keepAtMost(1);
  EXPECT_EQ(particles.all().ids, (std::vector<std::uint32_t>{3})) << "then whatever is oldest";
}

}  // namespace
}  // namespace sluice::sources::test
