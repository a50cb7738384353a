#include "sluice/client/scene_update.h"

#include <initializer_list>
#include <vector>

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "sluice/client/failure.h"

namespace sluice::client {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

v1::UpdateScene update(std::initializer_list<std::string> assignments) {
  return sceneUpdate(std::vector<std::string>(assignments));
}

/// The complaint about an assignment.
std::string complaint(std::initializer_list<std::string> assignments) {
  try {
    update(assignments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "(taken)";
}

testing::AssertionResult isScene(const v1::Scene& scene, const std::string& expected) {
  v1::Scene wanted;
  if (!google::protobuf::TextFormat::ParseFromString(expected, &wanted)) {
    return testing::AssertionFailure() << "the test's scene does not parse";
  }
  if (google::protobuf::util::MessageDifferencer::Equals(scene, wanted)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << scene.ShortDebugString();
}

TEST(SceneUpdate, SetsEveryKindOfValue) {
  EXPECT_TRUE(isScene(update({"look.smoothing.time=2.5"}).scene(), "look { smoothing { time: 2.5 } }"));
  EXPECT_TRUE(isScene(update({"seed=7"}).scene(), "seed: 7"));
  EXPECT_TRUE(isScene(update({"look.liquid.opaque=true"}).scene(), "look { liquid { opaque: true } }"));
  EXPECT_TRUE(
      isScene(update({"title=A pool, at \"night\" = dark"}).scene(), R"(title: "A pool, at \"night\" = dark")"));
  EXPECT_TRUE(isScene(update({"title="}).scene(), R"(title: "")"));
}

TEST(SceneUpdate, SetsVectorsByNumbersTextAndComponent) {
  const char* gravity = "simulation { gravity { x: 1 y: -2.5 z: 0 } }";
  EXPECT_TRUE(isScene(update({"simulation.gravity=1,-2.5,0"}).scene(), gravity));
  EXPECT_TRUE(isScene(update({"simulation.gravity={x: 1 y: -2.5 z: 0}"}).scene(), gravity));
  EXPECT_TRUE(isScene(update({"simulation.gravity.y=-3"}).scene(), "simulation { gravity { y: -3 } }"));
}

TEST(SceneUpdate, ReachesElementsOfListsInTheirPlace) {
  const v1::UpdateScene third = update({"simulation.fluids[0].blocks[2].count_x=4"});
  EXPECT_TRUE(isScene(third.scene(), "simulation { fluids { blocks {} blocks {} blocks { count_x: 4 } } }"));
  EXPECT_THAT(third.mask().paths(), ElementsAre("simulation.fluids[0].blocks[2].count_x"));
  EXPECT_TRUE(isScene(update({"simulation.fluids[0].blocks[0]={count_y: 3}"}).scene(),
                      "simulation { fluids { blocks { count_y: 3 } } }"));
}

TEST(SceneUpdate, SetsWholeLists) {
  EXPECT_TRUE(isScene(update({"simulation.fluids[0].blocks=[{count_x: 1}, {count_x: 2}]"}).scene(),
                      "simulation { fluids { blocks { count_x: 1 } blocks { count_x: 2 } } }"));
}

TEST(SceneUpdate, ChoosesMembersOfOneofs) {
  EXPECT_TRUE(isScene(update({"look.smoothing.bilateral={}"}).scene(), "look { smoothing { bilateral {} } }"));
  EXPECT_THAT(complaint({"look.smoothing.bilateral={}", "look.smoothing.curvature_flow.max_iterations=5"}),
              AllOf(HasSubstr("look.smoothing.curvature_flow"), HasSubstr("bilateral"), HasSubstr("method")));
}

TEST(SceneUpdate, NamesEveryPathOnceInOrder) {
  const v1::UpdateScene both = update({"seed=1", "look.smoothing.time=1", "seed=2"});
  EXPECT_THAT(both.mask().paths(), ElementsAre("seed", "look.smoothing.time"));
  EXPECT_EQ(both.scene().seed(), 2U);
}

TEST(SceneUpdate, LaterMessagesReplaceEarlierValues) {
  EXPECT_TRUE(isScene(update({"camera.eye.x=5", "camera.eye={y: 1}"}).scene(), "camera { eye { y: 1 } }"));
  EXPECT_TRUE(isScene(update({"camera.eye={y: 1}", "camera.eye.x=5"}).scene(), "camera { eye { x: 5 y: 1 } }"));
}

TEST(SceneUpdate, RefusesUnknownFieldsNamingTheOthers) {
  EXPECT_THAT(complaint({"look.smoothing.tim=1"}),
              AllOf(HasSubstr("look.smoothing.tim: there is no such field"), HasSubstr("time, bilateral")));
  EXPECT_THAT(complaint({"lok=1"}), AllOf(HasSubstr("lok: "), HasSubstr("a scene has title")));
  EXPECT_THAT(complaint({"look.smoothing.time.x=1"}), HasSubstr("look.smoothing.time: is a number and has no fields"));
}

TEST(SceneUpdate, RefusesIndicesThatCannotBe) {
  EXPECT_THAT(complaint({"simulation.fluids.viscosity=1"}), HasSubstr("simulation.fluids[0]"));
  EXPECT_THAT(complaint({"simulation.fluids[8].viscosity=1"}), HasSubstr("at most 7"));
  EXPECT_THAT(complaint({"simulation.fluids[0].blocks[4000000000].count_x=1"}), HasSubstr("at most 999"));
  EXPECT_THAT(complaint({"look[0].smoothing.time=1"}), HasSubstr("takes no index"));
}

TEST(SceneUpdate, RefusesValuesOfTheWrongKindSayingWhichIsRight) {
  EXPECT_THAT(complaint({"look.smoothing.time=fast"}),
              AllOf(HasSubstr("look.smoothing.time: 'fast'"), HasSubstr("a number")));
  EXPECT_THAT(complaint({"look.smoothing.time="}), HasSubstr("a number"));
  EXPECT_THAT(complaint({"look.smoothing.time=1 2"}), HasSubstr("a number"));
  EXPECT_THAT(complaint({"seed=-1"}), HasSubstr("a whole number, not negative"));
  EXPECT_THAT(complaint({"look.liquid.opaque=perhaps"}), HasSubstr("true or false"));
  EXPECT_THAT(complaint({"simulation.gravity=1,2"}), HasSubstr("three numbers"));
  EXPECT_THAT(complaint({"simulation.gravity=1,2,3,4"}), HasSubstr("three numbers"));
  EXPECT_THAT(complaint({"look.smoothing.bilateral=yes"}), HasSubstr("a message such as {}"));
  EXPECT_THAT(complaint({"look.smoothing.bilateral={tim: 1}"}), HasSubstr("tim"));
  EXPECT_THAT(complaint({"simulation.fluids[0].blocks=[{}] name: 'x'"}), HasSubstr("a list"));
}

TEST(SceneUpdate, RefusesWhatIsNoAssignment) {
  EXPECT_THAT(complaint({"look.smoothing.time"}), HasSubstr("path=value"));
  EXPECT_THAT(complaint({"=1"}), HasSubstr("no field path"));
}

}  // namespace
}  // namespace sluice::client
