#include <gmock/gmock.h>

#include "support.h"

namespace sluice::scene::test {
namespace {

using core::InputError;
using testing::HasSubstr;

InputError parseError(const std::string& text) {
  return inputError([&] { parse(text, "pool.textproto"); });
}

TEST(Parse, GivesACompleteScene) {
  const v1::Scene scene = smallScene();
  EXPECT_EQ(scene.simulation().fluids(0).blocks(0).count_x(), 2U);
  EXPECT_TRUE(scene.simulation().has_dfsph());
  EXPECT_TRUE(scene.look().liquid().has_refractive_index());
}

TEST(Parse, NamesThePlaceOfAValueOutOfRange) {
  const InputError error = parseError(
      "simulation {\n"
      "  container { min { x: -1 y: -1 z: -1 } max { x: 1 y: 1 z: 1 } }\n"
      "  fluids {\n"
      "    viscosity: -1\n"
      "    blocks { first_particle { x: 0 } }\n"
      "  }\n"
      "}\n");
  EXPECT_STREQ(error.what(), "pool.textproto:4:5: simulation.fluids[0].viscosity: -1 is outside [0, 100] m²/s");
}

TEST(Parse, NamesThePlaceOfAVectorsComponent) {
  const InputError error =
      parseError(std::string(kSmallScene) + "look { liquid { absorption {\n x: 1\n   y: nan } } }");
  EXPECT_EQ(error.where(), "pool.textproto:9:4");
  EXPECT_EQ(error.fieldPath(), "look.liquid.absorption.y");
  EXPECT_EQ(error.problem(), "nan is not a finite number; allowed is [0, 10000] 1/m");
}

TEST(Parse, CountsTheElementsOfLists) {
  const InputError error = parseError(
      "simulation {\n"
      "  container { min { x: -1 } max { x: 1 y: 1 z: 1 } }\n"
      "  fluids {\n"
      "    blocks: [{ first_particle { x: 0 } },\n"
      "             { first_particle { x: 0 } count_y: 0 }]\n"
      "  }\n"
      "}\n");
  EXPECT_EQ(error.where(), "pool.textproto:5:40");
  EXPECT_EQ(error.fieldPath(), "simulation.fluids[0].blocks[1].count_y");
}

TEST(Parse, PlacesAMissingFieldAtTheMessageThatLacksIt) {
  const InputError error = parseError("title: \"empty\"\nsimulation {\n  container { max { x: 1 } }\n}\n");
  EXPECT_EQ(error.where(), "pool.textproto:3:3");
  EXPECT_EQ(error.fieldPath(), "simulation.container.min");
  EXPECT_THAT(error.problem(), HasSubstr("is missing"));
}

TEST(Parse, SuggestsTheNameThatWasMeant) {
  const InputError error = parseError("simulation {\n  fluids {\n    viscocity: 1\n  }\n}\n");
  EXPECT_STREQ(error.what(), "pool.textproto:3:5: Fluid has no field \"viscocity\"; did you mean viscosity?");
}

TEST(Parse, FindsTheColumnBehindTabs) {
  EXPECT_EQ(parseError("simulation {\n\tfluids {}\n\n \twibble: 1\n}\n").where(), "pool.textproto:4:9");
}

TEST(Parse, ListsTheNamesWhereNoneIsNear) {
  EXPECT_THAT(parseError("playback { wibble: 1 }").problem(), HasSubstr("there is speed, paused"));
}

TEST(Parse, RefusesWhatIsNotTextFormat) {
  EXPECT_EQ(parseError("simulation {").where(), "pool.textproto:1:13");
  EXPECT_EQ(parseError("title: \"a\"\ntitle: \"b\"").where().substr(0, 17), "pool.textproto:2:");
  EXPECT_THAT(parseError("seed: 1.5").problem(), HasSubstr("1.5"));
  EXPECT_THAT(parseError("seed: -1").problem(), HasSubstr("-"));
  EXPECT_THAT(parseError("title: \"a\nb\"").problem(), HasSubstr("ine"));
  parseError(std::string("\0\0\xff", 3));
}

TEST(Parse, RefusesTwoMembersOfAChoice) {
  EXPECT_THAT(parseError("simulation {} particle_file {}").problem(), HasSubstr("particle_file"));
}

TEST(Parse, RefusesTextThatIsNotUtf8) {
  EXPECT_EQ(parseError(std::string(kSmallScene) + "title: \"\\377\"").fieldPath(), "title");
}

TEST(Parse, SaysOneLineWhateverTheText) {
  for (const std::string text : {"a\nb: {\n", "simulation { \"x\ny\" }", "look { [a.b\n]: 1 }"}) {
    EXPECT_EQ(std::string(parseError(text).what()).find('\n'), std::string::npos) << text;
  }
}

// A viewer may send any text.
TEST(Parse, SurvivesTruncationAtEveryLength) {
  const std::string text = kSmallScene;
  const std::size_t end = text.rfind('}');
  for (std::size_t length = 0; length <= end; ++length) {
    EXPECT_THROW(parse(text.substr(0, length), "cut.textproto"), InputError) << length;
  }
}

TEST(Parse, SurvivesDeepNesting) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "simulation {";
  EXPECT_THROW(parse(text, "deep.textproto"), InputError);
}

}  // namespace
}  // namespace sluice::scene::test
