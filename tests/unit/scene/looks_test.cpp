#include <gmock/gmock.h>

#include "sluice/scene/looks.h"
#include "support.h"

namespace sluice::scene::test {
namespace {

using testing::HasSubstr;

v1::Scene sceneWith(const std::string& look) { return parse(std::string(kSmallScene) + look, "small.textproto"); }

TEST(Looks, AreValidAndAreWhatThePresetTakes) {
  std::vector<std::string> names;
  for (const ShippedLook& shipped : shippedLooks()) {
    EXPECT_FALSE(shipped.description.empty());
    EXPECT_NO_THROW(sceneWith("look { preset: \"" + shipped.name + "\" }")) << shipped.name;
    names.push_back(shipped.name);
  }
  const auto* const preset = v1::Look::descriptor()->FindFieldByName("preset");
  const auto& words = preset->options().GetExtension(v1::info).words();
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(words.begin(), words.end()));
}

TEST(Looks, StandUnderWhatTheSceneSets) {
  const v1::Liquid honey = sceneWith("look { preset: \"honey\" }").look().liquid();
  const v1::Liquid liquid = sceneWith("look { preset: \"honey\" liquid { absorption { x: 5 } } }").look().liquid();
  EXPECT_EQ(liquid.refractive_index(), honey.refractive_index());
  EXPECT_NE(honey.refractive_index(), v1::Liquid().refractive_index());
  EXPECT_EQ(liquid.absorption().x(), 5);
  EXPECT_EQ(liquid.absorption().y(), 0) << "a vector is one value";
}

TEST(Looks, LeaveAChosenMemberOfAOneof) {
  const v1::Liquid liquid = sceneWith("look { preset: \"water\" liquid { phong { shininess: 9 } } }").look().liquid();
  EXPECT_TRUE(liquid.has_phong());
  EXPECT_EQ(liquid.phong().shininess(), 9);
}

TEST(Looks, AreThoseOfFurtherLiquidsToo) {
  const v1::Scene scene = sceneWith("more_looks { preset: \"mercury\" }");
  EXPECT_TRUE(scene.more_looks(0).liquid().has_metal());
  EXPECT_FALSE(scene.look().liquid().has_metal());
}

TEST(Looks, SetLiveReplaceTheOptics) {
  v1::Scene scene = sceneWith("look { preset: \"sea\" splats { radius_in_spacings: 1.1 } }");
  EXPECT_TRUE(scene.look().has_noise());
  const std::array assignments{std::string("look.preset=milk")};
  assign(scene, assignments);
  v1::Scene milk = sceneWith("look { preset: \"milk\" splats { radius_in_spacings: 1.1 } }");
  EXPECT_EQ(scene.SerializeAsString(), milk.SerializeAsString());
}

TEST(Looks, TakeLaterAssignmentsOverThem) {
  v1::Scene scene = smallScene();
  const std::array assignments{std::string("look.preset=milk"), std::string("look.liquid.refractive_index=1.7")};
  assign(scene, assignments);
  EXPECT_EQ(scene.look().liquid().refractive_index(), 1.7);
  EXPECT_EQ(scene.look().liquid().absorption().x(),
            sceneWith("look { preset: \"milk\" }").look().liquid().absorption().x());
}

TEST(Looks, ComeByUpdatesToo) {
  const v1::Scene current = smallScene();
  v1::Scene partial;
  partial.mutable_look()->set_preset("mercury");
  google::protobuf::FieldMask mask;
  mask.add_paths("look.preset");
  EXPECT_TRUE(applyUpdate(current, partial, mask).scene.look().liquid().has_metal());
  mask.set_paths(0, "look");
  partial.mutable_look()->mutable_liquid()->set_refractive_index(2);
  const v1::Look look = applyUpdate(current, partial, mask).scene.look();
  EXPECT_TRUE(look.liquid().has_metal());
  EXPECT_EQ(look.liquid().refractive_index(), 2);
}

TEST(Looks, OfOtherNamesAreRefusedWhereTheyStand) {
  const core::InputError error = inputError([] { sceneWith("look { preset: \"mild\" }"); });
  EXPECT_THAT(error.what(), HasSubstr("small.textproto:7:8"));
  EXPECT_THAT(error.what(), HasSubstr("look.preset"));
  EXPECT_THAT(error.what(), HasSubstr("milk"));
}

}  // namespace
}  // namespace sluice::scene::test
