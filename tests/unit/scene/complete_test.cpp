#include "support.h"

namespace sluice::scene::test {
namespace {

TEST(Complete, WritesEveryDefaultOut) {
  v1::Simulation simulation;
  complete(simulation);
  EXPECT_TRUE(simulation.has_particle_spacing());
  EXPECT_EQ(simulation.particle_spacing(), 0.05);
  EXPECT_EQ(simulation.gravity().y(), -9.81);
  EXPECT_TRUE(simulation.gravity().has_x());
  EXPECT_TRUE(simulation.dfsph().has_warm_start());
}

TEST(Complete, KeepsWhatIsSet) {
  v1::Liquid liquid;
  liquid.set_refractive_index(2);
  liquid.mutable_physical()->set_specular(0);
  complete(liquid);
  EXPECT_EQ(liquid.refractive_index(), 2);
  EXPECT_EQ(liquid.physical().specular(), 0);
}

TEST(Complete, GivesZeroToTheOtherComponentsOfAVector) {
  v1::Liquid liquid;
  liquid.mutable_absorption()->set_x(5);
  complete(liquid);
  EXPECT_TRUE(liquid.absorption().has_y());
  EXPECT_EQ(liquid.absorption().y(), 0) << "not the default's component";
}

TEST(Complete, ChoosesDefaultMembers) {
  v1::Simulation simulation;
  complete(simulation);
  EXPECT_TRUE(simulation.has_dfsph());
  EXPECT_TRUE(simulation.dfsph().has_max_iterations());
}

TEST(Complete, KeepsTheChosenMember) {
  v1::Smoothing smoothing;
  smoothing.mutable_bilateral();
  complete(smoothing);
  EXPECT_TRUE(smoothing.has_bilateral());
  EXPECT_TRUE(smoothing.bilateral().has_depth_deviation_in_radii());
}

TEST(Complete, FillsTheElementsOfLists) {
  v1::Fluid fluid;
  fluid.add_blocks();
  fluid.add_blocks();
  complete(fluid);
  EXPECT_TRUE(fluid.blocks(1).has_count_z());
  EXPECT_TRUE(fluid.blocks(1).has_velocity());
}

TEST(Complete, LeavesRequiredFieldsToTheScene) {
  v1::Scene scene;
  complete(scene);
  EXPECT_TRUE(scene.has_simulation());
  EXPECT_FALSE(scene.simulation().container().has_min());
}

TEST(Complete, IsIdempotent) {
  const v1::Scene scene = smallScene();
  v1::Scene again = scene;
  complete(again);
  EXPECT_EQ(again.SerializeAsString(), scene.SerializeAsString());
}

}  // namespace
}  // namespace sluice::scene::test
