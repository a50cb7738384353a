#include "quality.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/scene/scene.h"
#include "sluice/sim/simulation.h"

namespace sluice::sim {
namespace {

v1::Scene atQualityOf(const v1::Scene& scene, const std::string& quality) {
  v1::Scene changed = scene;
  const std::vector<std::string> assignments{"quality=" + quality};
  scene::assign(changed, assignments);
  return changed;
}

std::vector<std::string> simulatedScenes() {
  std::vector<std::string> names;
  for (const scene::ShippedScene& shipped : scene::shippedScenes()) {
    if (scene::loadShipped(shipped.name).has_simulation()) names.push_back(shipped.name);
  }
  return names;
}

class ShippedSceneAtQuality : public testing::TestWithParam<std::string> {};

TEST_P(ShippedSceneAtQuality, FillsTheSameVolumesWithAThirdOfTheParticles) {
  const v1::Scene full = scene::loadShipped(GetParam());
  const v1::Scene draft = atQualityOf(full, "draft");
  const auto ofFull = makeSimulation(full, 1)->snapshot();
  const auto ofDraft = makeSimulation(draft, 1)->snapshot();
  EXPECT_NEAR(ofDraft->spacing / ofFull->spacing, std::cbrt(3), 0.051 * std::cbrt(3));
  // What starts from a nozzle alone starts with a layer or two.
  if (ofFull->size() < 300) return;
  const double share = static_cast<double>(ofDraft->size()) / static_cast<double>(ofFull->size());
  EXPECT_NEAR(share, 1.0 / 3, 0.07);
  const double rounding = ofDraft->spacing + ofFull->spacing;
  EXPECT_LT((ofDraft->bounds.min() - ofFull->bounds.min()).norm(), std::sqrt(3) * rounding);
  EXPECT_LT((ofDraft->bounds.max() - ofFull->bounds.max()).norm(), std::sqrt(3) * rounding);
}

TEST_P(ShippedSceneAtQuality, RunsAsADraft) {
  const auto simulation = makeSimulation(atQualityOf(scene::loadShipped(GetParam()), "draft"), 2);
  for (int step = 0; step < 10; ++step) ASSERT_TRUE(simulation->advance()) << simulation->halted();
}

INSTANTIATE_TEST_SUITE_P(All, ShippedSceneAtQuality, testing::ValuesIn(simulatedScenes()),
                         [](const auto& tested) { return tested.param; });

TEST(Quality, FullIsTheSceneItself) {
  const v1::Scene scene = sceneOf(smallDamBreak());
  EXPECT_EQ(atQuality(scene).SerializeAsString(), scene.simulation().SerializeAsString());
}

TEST(Quality, FineTriplesTheParticles) {
  v1::Scene scene = sceneOf(smallDamBreak());
  scene.set_quality("fine");
  EXPECT_NEAR(static_cast<double>(makeSimulation(scene, 1)->snapshot()->size()), 9000, 900);
}

double meanHeight(const core::ParticleSnapshot& snapshot) {
  double sum = 0;
  for (const Eigen::Vector3f& x : snapshot.positions) sum += x.y();
  return sum / static_cast<double>(snapshot.size());
}

// Blocks fill the floor of their container from wall to wall at any quality. Coarser particles keep farther from it and
// from the walls: the same volume stands higher, by about 0.025 m as a draft.
TEST(Quality, AColumnAtRestStaysAtRest) {
  for (const char* quality : {"draft", "full", "fine"}) {
    v1::Scene scene = sceneOf(column(12, 8));
    scene.set_quality(quality);
    const auto simulation = makeSimulation(scene, 2);
    EXPECT_NEAR(meanHeight(*simulation->snapshot()), 0.225, 0.03) << quality;
    while (simulation->time() < 0.3) ASSERT_TRUE(simulation->advance());
    EXPECT_NEAR(meanHeight(*simulation->snapshot()), 0.225, 0.03) << quality;
  }
}

TEST(Quality, BlocksThatTouchStillTouch) {
  v1::Scene scene = sceneOf(layeredTank(1000, 800));
  for (const char* quality : {"draft", "fine"}) {
    scene.set_quality(quality);
    const v1::Simulation changed = atQuality(scene);
    const v1::Block& below = changed.fluids(0).blocks(0);
    const v1::Block& above = changed.fluids(1).blocks(0);
    EXPECT_NEAR(below.first_particle().y() + below.count_y() * changed.particle_spacing(), above.first_particle().y(),
                1e-9);
    EXPECT_NO_THROW(makeSimulation(scene, 1));
  }
}

TEST(Quality, PlanarScenesScaleWithTheSquareRoot) {
  v1::Scene scene = sceneOf(floatingCube(30));
  v1::Block* block = scene.mutable_simulation()->mutable_fluids(0)->mutable_blocks(0);
  block->set_count_z(1);
  scene.mutable_simulation()->set_planar(true);
  scene.set_quality("draft");
  EXPECT_NEAR(static_cast<double>(makeSimulation(scene, 1)->snapshot()->size()), 300, 40);
  EXPECT_EQ(atQuality(scene).fluids(0).blocks(0).first_particle().z(), block->first_particle().z());
}

// A paused slider changes what applies live, at the quality that the simulation runs at.
TEST(Quality, SurvivesAnUpdate) {
  v1::Scene scene = sceneOf(smallDamBreak());
  scene.set_quality("draft");
  const auto simulation = makeSimulation(scene, 1);
  scene.mutable_simulation()->mutable_gravity()->set_y(-1);
  simulation->update(scene);
  EXPECT_TRUE(simulation->advance());
  EXPECT_NEAR(static_cast<double>(simulation->snapshot()->size()), 1000, 150);
}

TEST(Quality, BudgetsFollowTheVolume) {
  v1::Scene scene = sceneOf(smallDamBreak());
  scene.mutable_simulation()->set_max_particles(6000);
  scene.mutable_simulation()->mutable_fluids(0)->add_emitters()->set_max_particles(300);
  scene.set_quality("draft");
  const v1::Simulation draft = atQuality(scene);
  const double factor = std::pow(scene.simulation().particle_spacing() / draft.particle_spacing(), 3);
  EXPECT_NEAR(factor, 1.0 / 3, 0.05);
  const v1::Block& block = draft.fluids(0).blocks(0);
  // The block of 3,000 takes half of it.
  EXPECT_NEAR(draft.max_particles(), block.count_x() * block.count_y() * block.count_z() + 3000 * factor, 1);
  EXPECT_NEAR(draft.fluids(0).emitters(0).max_particles(), 300 * factor, 1);
}

}  // namespace
}  // namespace sluice::sim
