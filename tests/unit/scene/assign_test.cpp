#include <gmock/gmock.h>

#include "support.h"

namespace sluice::scene::test {
namespace {

using testing::HasSubstr;

v1::Scene assigned(std::vector<std::string> assignments) {
  v1::Scene scene = smallScene();
  assign(scene, assignments);
  return scene;
}

core::InputError assignError(std::vector<std::string> assignments) {
  return inputError([&] { assigned(assignments); });
}

TEST(Assign, SetsValuesOfEveryType) {
  const v1::Scene scene =
      assigned({"title= A pool ", "seed=18446744073709551615", "look.liquid.opaque=true", "look.smoothing.time=2.5",
                "simulation.dfsph.max_iterations=7", "camera.eye=1, -2,3e1"});
  EXPECT_EQ(scene.title(), "A pool");
  EXPECT_EQ(scene.seed(), 18446744073709551615U);
  EXPECT_TRUE(scene.look().liquid().opaque());
  EXPECT_EQ(scene.look().smoothing().time(), 2.5);
  EXPECT_EQ(scene.simulation().dfsph().max_iterations(), 7U);
  EXPECT_EQ(scene.camera().eye().y(), -2);
  EXPECT_EQ(scene.camera().eye().z(), 30);
}

TEST(Assign, FollowsIndices) {
  const v1::Scene scene = assigned({"simulation.fluids[0].blocks[0].count_z=9"});
  EXPECT_EQ(scene.simulation().fluids(0).blocks(0).count_z(), 9U);
}

TEST(Assign, AddsAnElementOnePastTheEnd) {
  const v1::Scene one = assigned({"bodies[0].box={}", "bodies[0].position.x=1"});
  ASSERT_EQ(one.bodies_size(), 1);
  EXPECT_EQ(one.bodies(0).position().x(), 1);
  EXPECT_EQ(one.bodies(0).box().size().y(), 0.2) << "completed";
  const v1::Scene two = assigned({"bodies[0]={name: \"ball\" sphere {radius: 0.3}}", "bodies[1].cylinder.radius=0.4"});
  ASSERT_EQ(two.bodies_size(), 2);
  EXPECT_EQ(two.bodies(0).sphere().radius(), 0.3);
  EXPECT_EQ(two.bodies(1).cylinder().radius(), 0.4);
  const v1::Scene looks = assigned({"more_looks[0].preset=honey"});
  ASSERT_EQ(looks.more_looks_size(), 1);
  EXPECT_EQ(looks.more_looks(0).liquid().refractive_index(),
            assigned({"look.preset=honey"}).look().liquid().refractive_index());
  EXPECT_EQ(
      assigned({"simulation.fluids[0].blocks[1].first_particle=0.1,0.5,0.1"}).simulation().fluids(0).blocks_size(), 2);
}

TEST(Assign, RefusesIndicesFartherOutAndElementsThatAreNotAllowed) {
  EXPECT_STREQ(assignError({"bodies[1].box={}"}).what(),
               "bodies[1].box: there is no element 1: bodies is empty; index 0 would add one");
  EXPECT_STREQ(assignError({"bodies[0]={}", "bodies[2]={}"}).what(),
               "bodies[2]: there is no element 2: bodies has 1 element; the only index is 0; index 1 would add one");
  EXPECT_EQ(assignError({"bodies[0].sphere.radius=-1"}).fieldPath(), "bodies[0].sphere.radius");
  EXPECT_EQ(assignError({"simulation.fluids[0].blocks[1].count_x=2"}).fieldPath(),
            "simulation.fluids[0].blocks[1].first_particle");
  std::vector<std::string> tooMany;
  for (int i = 0; i < 8; ++i) tooMany.push_back("more_looks[" + std::to_string(i) + "]={}");
  EXPECT_EQ(assignError(tooMany).fieldPath(), "more_looks");
}

TEST(Assign, ChangesOneComponentAndKeepsTheOthers) {
  const v1::Scene scene = assigned({"camera.eye.x=7"});
  EXPECT_EQ(scene.camera().eye().x(), 7);
  EXPECT_EQ(scene.camera().eye().z(), 3);
}

TEST(Assign, ChoosesAMemberByAnEmptyGroup) {
  const v1::Scene scene = assigned({"look.smoothing.bilateral={}"});
  EXPECT_TRUE(scene.look().smoothing().has_bilateral());
  EXPECT_EQ(scene.look().smoothing().bilateral().depth_deviation_in_radii(), 1.5);
}

TEST(Assign, ChoosesAMemberByAPathThroughIt) {
  const v1::Scene scene = assigned({"look.smoothing.bilateral.depth_deviation_in_radii=4"});
  EXPECT_EQ(scene.look().smoothing().bilateral().depth_deviation_in_radii(), 4);
}

TEST(Assign, TakesGroupsInTextFormat) {
  const v1::Scene scene = assigned({"simulation.container={min {x: -2 y: -2 z: -2} max {x: 2 y: 2 z: 2}}"});
  EXPECT_EQ(scene.simulation().container().max().y(), 2);
}

TEST(Assign, AppliesInOrder) {
  EXPECT_EQ(assigned({"look.smoothing.time=2", "look.smoothing.time=3"}).look().smoothing().time(), 3);
}

TEST(Assign, NamesTheSegmentThatDoesNotExist) {
  EXPECT_STREQ(assignError({"simulation.fluids[0].viscocity=1"}).what(),
               "simulation.fluids[0].viscocity: simulation.fluids[0] has no field \"viscocity\"; did you mean "
               "viscosity?");
  EXPECT_THAT(assignError({"wibble=1"}).problem(), HasSubstr("there is title, description, seed"));
}

TEST(Assign, ExplainsPathsThatLeadNowhere) {
  EXPECT_THAT(assignError({"simulation.fluids[3].viscosity=1"}).problem(), HasSubstr("the only index is 0"));
  EXPECT_THAT(assignError({"simulation.fluids.viscosity=1"}).problem(), HasSubstr("fluids[0]"));
  EXPECT_THAT(assignError({"simulation.fluids={}"}).problem(), HasSubstr("fluids[0]"));
  EXPECT_THAT(assignError({"seed.x=1"}).problem(), HasSubstr("single value"));
  EXPECT_THAT(assignError({"camera[0].eye=1,2,3"}).problem(), HasSubstr("not a list"));
}

TEST(Assign, RefusesWhatIsNotAPathOrAssignment) {
  for (const std::string text : {"", "=", "=1", "seed", ".seed=1", "seed.=1", "simulation..fluids=1",
                                 "simulation.fluids[=1", "simulation.fluids[-1]=1", "simulation.fluids[0=1",
                                 "simulation.fluids[0]x=1", "simulation.fluids[99999999999]=1"}) {
    EXPECT_THROW(assigned({text}), core::InputError) << text;
  }
}

TEST(Assign, SaysWhatIsAllowedInsteadOfAValue) {
  EXPECT_STREQ(assignError({"look.smoothing.time=fast"}).what(),
               "look.smoothing.time: \"fast\" is not a number; allowed is [0, 50] d²");
  EXPECT_STREQ(assignError({"simulation.dfsph.max_iterations=2.5"}).what(),
               "simulation.dfsph.max_iterations: \"2.5\" is not a whole number; allowed is [2, 10000]");
  EXPECT_STREQ(assignError({"look.liquid.opaque=maybe"}).what(), "look.liquid.opaque: \"maybe\" is not true or false");
  EXPECT_THAT(assignError({"camera.eye=1,2"}).problem(), HasSubstr("1,2,3"));
  EXPECT_THAT(assignError({"camera.eye=1,2,3,4"}).problem(), HasSubstr("1,2,3"));
  EXPECT_THAT(assignError({"look.smoothing=4"}).problem(), HasSubstr("time, bilateral, curvature_flow"));
  EXPECT_THAT(assignError({"look.smoothing={wibble: 4}"}).problem(), HasSubstr("wibble"));
  EXPECT_THAT(assignError({"seed=-1"}).problem(), HasSubstr("whole number"));
}

TEST(Assign, ChecksRanges) {
  EXPECT_STREQ(assignError({"simulation.fluids[0].viscosity=-1"}).what(),
               "simulation.fluids[0].viscosity: -1 is outside [0, 100] m²/s");
  EXPECT_STREQ(assignError({"look.smoothing.curvature_flow.step_fraction=1.05"}).what(),
               "look.smoothing.curvature_flow.step_fraction: 1.05 is outside [0.01, 1] × largest stable step");
  EXPECT_EQ(assignError({"look.smoothing.time=nan"}).fieldPath(), "look.smoothing.time");
}

TEST(Assign, DoesAllOrNothing) {
  v1::Scene scene = smallScene();
  const std::string before = scene.SerializeAsString();
  const std::vector<std::string> assignments{"seed=5", "look.smoothing.time=-1"};
  EXPECT_THROW(assign(scene, assignments), core::InputError);
  EXPECT_EQ(scene.SerializeAsString(), before);
}

}  // namespace
}  // namespace sluice::scene::test
