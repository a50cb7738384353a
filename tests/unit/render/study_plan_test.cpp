// Plans of study views, colour maps and legends: what each runs, and why the rest is left out.
#include <gmock/gmock.h>

#include <algorithm>

#include "sluice/render/frame_plan.h"
#include "sluice/scene/scene.h"

namespace sluice::render {
namespace {

class StudyPlan : public ::testing::Test {
 protected:
  StudyPlan() {
    scene::complete(scene);
    traits.spacing = 0.02;
    traits.points = 1000;
    traits.nearestDepth = 2;
    traits.pixelSlope = 1e-3;
    traits.velocities = true;
    traits.ids = true;
  }

  FramePlan plan() const { return planFrame(scene, size, std::vector<DataTraits>(liquids, traits), reuse, device); }
  std::string reason(std::string_view what) const {
    for (const core::LeftOut& entry : plan().leftOut) {
      if (entry.name == what) return entry.reason;
    }
    return "";
  }
  void useColourMap() {
    scene.mutable_look()->mutable_colour_map();
    scene::complete(scene);
  }
  void useNoise() {
    scene.mutable_look()->mutable_noise();
    scene::complete(scene);
  }
  void useFoam(std::size_t dots) {
    scene.mutable_foam();
    scene::complete(scene);
    traits.foamDots = dots;
  }

  v1::Scene scene;
  v1::View& view = *scene.mutable_view();
  DataTraits traits;
  std::size_t liquids = 1;
  core::ImageSize size{640, 480};
  ReuseTraits reuse;
  DeviceTraits device;
};

TEST_F(StudyPlan, NoiseIsDrawnForItsOwnViewAlone) {
  useNoise();
  view.mutable_thickness();
  EXPECT_FALSE(plan().runs(Pass::Noise));
  view.mutable_noise();
  const FramePlan p = plan();
  EXPECT_TRUE(p.runs(Pass::Noise));
  EXPECT_EQ(p.buffer(Resource::Violence), nullptr) << "the height alone";
  EXPECT_FALSE(p.runs(Pass::Thickness));
  EXPECT_TRUE(p.runs(Pass::Legend));
  const auto study = std::ranges::find(p.steps, Pass::Study, &PassStep::pass);
  ASSERT_NE(study, p.steps.end());
  EXPECT_THAT(study->reads, ::testing::Contains(BufferId{Resource::Noise}));
}

TEST_F(StudyPlan, WithoutNoiseItsViewSaysSo) {
  view.mutable_noise();
  EXPECT_TRUE(plan().runs(Pass::Study));
  EXPECT_FALSE(plan().runs(Pass::Noise));
  EXPECT_EQ(reason("noise"), "look.noise is not set");
  EXPECT_EQ(reason("legend"), "no colour stands for a value");
}

TEST_F(StudyPlan, FoamIsDrawnForItsOwnViewAlone) {
  useFoam(10);
  view.mutable_normals();
  EXPECT_FALSE(plan().runs(Pass::Foam));
  EXPECT_EQ(reason("foam"), "the view does not show it");
  view.mutable_foam();
  const FramePlan p = plan();
  EXPECT_TRUE(p.runs(Pass::Foam));
  EXPECT_TRUE(p.runs(Pass::StudyFoam));
  EXPECT_FALSE(p.runs(Pass::BlendFoam));
  EXPECT_TRUE(p.runs(Pass::Legend));
}

TEST_F(StudyPlan, WithoutFoamItsViewSaysWhy) {
  view.mutable_foam();
  EXPECT_FALSE(plan().runs(Pass::StudyFoam));
  EXPECT_EQ(reason("foam"), "the scene has no foam");
  useFoam(0);
  EXPECT_EQ(reason("foam"), "no secondary particle is in the picture");
  EXPECT_TRUE(plan().runs(Pass::Legend)) << "of the liquid, which is seen to have none";
  traits.points = 0;
  EXPECT_FALSE(plan().runs(Pass::Legend));
}

TEST_F(StudyPlan, LegendNeedsColoursThatStandForValues) {
  EXPECT_EQ(reason("legend"), "no colour stands for a value");
  useColourMap();
  EXPECT_TRUE(plan().runs(Pass::Legend));
  EXPECT_EQ(plan().steps.back().pass, Pass::Legend);
  scene.mutable_look()->mutable_colour_map()->set_strength(0);
  EXPECT_FALSE(plan().runs(Pass::Legend));
  scene.mutable_look()->mutable_colour_map()->set_strength(1);
  view.mutable_spheres();
  EXPECT_TRUE(plan().runs(Pass::Legend));
  scene.mutable_look()->clear_colour_map();
  EXPECT_EQ(reason("legend"), "no colour stands for a value");
  view.mutable_raw_depth();
  EXPECT_TRUE(plan().runs(Pass::Legend));
  traits.points = 0;
  EXPECT_EQ(reason("legend"), "no colour stands for a value");
}

TEST_F(StudyPlan, LegendIsLeftOutWhereItIsNotWantedOrDoesNotFit) {
  useColourMap();
  view.set_legend(false);
  EXPECT_EQ(reason("legend"), "view.legend is off");
  view.set_legend(true);
  size = {159, 400};
  EXPECT_EQ(reason("legend"), "the picture is too small to hold it");
  size = {160, 120};
  EXPECT_TRUE(plan().runs(Pass::Legend));
  liquids = 3;
  EXPECT_EQ(reason("legend"), "the picture is too small to hold it");
  size = {640, 480};
  EXPECT_TRUE(plan().runs(Pass::Legend));
}

TEST_F(StudyPlan, KeptPictureKeepsItsLegend) {
  reuse.picture = true;
  EXPECT_FALSE(plan().runs(Pass::Legend));
  EXPECT_EQ(reason("legend"), "the last frame had none");
  reuse.legend = true;
  const FramePlan p = plan();
  ASSERT_EQ(p.steps.size(), 2U);
  EXPECT_EQ(p.steps.back().pass, Pass::Legend);
}

TEST_F(StudyPlan, ColourMapNeedsSumsWhereADeviceDrawsIt) {
  useColourMap();
  EXPECT_EQ(plan().buffer(Resource::AttributeSums), nullptr);
  device.software = false;
  const FramePlan p = plan();
  ASSERT_NE(p.buffer(Resource::AttributeSums), nullptr);
  EXPECT_EQ(p.buffer(Resource::AttributeSums)->size, p.buffer(Resource::Attribute)->size);
}

}  // namespace
}  // namespace sluice::render
