#include "sluice/render/frame_plan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sluice/scene/scene.h"

namespace sluice::render {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::Not;

class FramePlanTest : public ::testing::Test {
 protected:
  FramePlanTest() {
    scene::complete(scene);
    traits.spacing = 0.02;
    traits.points = 1000;
    traits.nearestDepth = 2;
    traits.pixelSlope = 1e-3;
  }

  FramePlan plan() const { return planFrame(scene, {640, 480}, liquids(), reuse, device); }
  std::vector<DataTraits> liquids() const {
    std::vector<DataTraits> all{traits};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// Why a frame does without it; empty where it does not.
  std::string whyNot(std::string_view what) const {
    for (const core::LeftOut& entry : plan().leftOut) {
      if (entry.name == what) return entry.reason;
    }
    return "";
  }
  static auto names(std::string_view name) { return Contains(Field(&core::LeftOut::name, std::string(name))); }

  v1::Scene scene;
  v1::Look& look = *scene.mutable_look();
  v1::Background& background = *scene.mutable_background();
  v1::Sun& sun = *scene.mutable_lighting()->mutable_sun();
  DataTraits traits;
  std::vector<DataTraits> more;  ///< Of further liquids.
  ReuseTraits reuse;
  DeviceTraits device;
};

TEST_F(FramePlanTest, IsPure) {
  EXPECT_EQ(plan().steps, plan().steps);
  EXPECT_EQ(plan().buffers, plan().buffers);
  EXPECT_EQ(plan().describe(), plan().describe());
}

TEST_F(FramePlanTest, DefaultRunsEveryPartOfTheLook) {
  const FramePlan p = plan();
  for (const Pass pass : {Pass::Background, Pass::Sunlight, Pass::SelectSplats, Pass::Splats, Pass::Mask,
                          Pass::Smoothing, Pass::Thickness, Pass::SmoothThickness, Pass::Composite}) {
    EXPECT_TRUE(p.runs(pass)) << name(pass);
  }
}

TEST_F(FramePlanTest, PassesReadOnlyWhatIsThere) {
  const google::protobuf::OneofDescriptor* const methods = v1::Smoothing::descriptor()->FindOneofByName("method");
  for (int i = 0; i < methods->field_count(); ++i) {
    for (const bool software : {false, true}) {
      for (const unsigned divisor : {1U, 2U}) {
        device.software = software;
        v1::Smoothing& smoothing = *look.mutable_smoothing();
        smoothing.GetReflection()->MutableMessage(&smoothing, methods->field(i));
        scene::complete(smoothing);
        smoothing.set_divisor(divisor);
        std::vector<BufferId> there{{Resource::Particles}};
        const FramePlan p = plan();
        for (const PassStep& step : p.steps) {
          for (const BufferId id : step.reads) EXPECT_THAT(there, Contains(id)) << step.name;
          there.insert(there.end(), step.writes.begin(), step.writes.end());
        }
        EXPECT_TRUE(p.runs(Pass::Smoothing)) << methods->field(i)->name();
        EXPECT_EQ(p.runs(Pass::BlendLiquid), divisor > 1);
      }
    }
  }
}

TEST_F(FramePlanTest, OpaqueLiquidNeedsNoThickness) {
  look.mutable_liquid()->set_opaque(true);
  const FramePlan p = plan();
  EXPECT_FALSE(p.runs(Pass::Thickness));
  EXPECT_EQ(p.buffer(Resource::Thickness), nullptr);
  EXPECT_THAT(p.leftOut, names("thickness"));
  EXPECT_THAT(p.leftOut, names("refraction"));
}

TEST_F(FramePlanTest, NoSmoothingTimeMeansNoSmoothingPass) {
  look.mutable_smoothing()->set_time(0);
  look.mutable_smoothing()->mutable_bilateral();
  const FramePlan p = plan();
  EXPECT_FALSE(p.runs(Pass::Smoothing));
  EXPECT_EQ(p.buffer(Resource::SurfaceScratch), nullptr);
  EXPECT_THAT(p.leftOut, names("smoothing"));
}

TEST_F(FramePlanTest, FlowOnTheCpuNeedsNoScratch) {
  look.mutable_smoothing()->mutable_rkl_curvature_flow();
  scene::complete(look);
  EXPECT_EQ(plan().buffer(Resource::SurfaceScratch), nullptr);
  device.software = false;
  for (const Resource scratch : kSurfaceScratch) EXPECT_NE(plan().buffer(scratch), nullptr) << name(scratch);
}

TEST_F(FramePlanTest, MaskFollowsErosion) {
  look.mutable_smoothing()->mutable_binomial();
  scene::complete(look);
  const auto masks = [&] { return std::ranges::count(plan().steps, Pass::Mask, &PassStep::pass); };
  EXPECT_EQ(masks(), 2);
  look.mutable_smoothing()->mutable_binomial()->set_silhouette_map(false);
  EXPECT_EQ(masks(), 1);
}

TEST_F(FramePlanTest, NoParticlesLeavesTheBackgroundAlone) {
  traits.points = 0;
  const FramePlan p = plan();
  EXPECT_EQ(p.steps.size(), 2U);  // the background, and its tone
  EXPECT_EQ(p.buffers.size(), 1U);
  EXPECT_THAT(p.leftOut, names("liquid"));
}

TEST_F(FramePlanTest, KeptBackgroundIsNotDrawnAgain) {
  reuse.background = true;
  const FramePlan p = plan();
  EXPECT_FALSE(p.runs(Pass::Background));
  EXPECT_NE(p.buffer(Resource::Background), nullptr);
}

TEST_F(FramePlanTest, KeptPictureNeedsNothing) {
  reuse.picture = true;
  const FramePlan p = plan();
  ASSERT_EQ(p.steps.size(), 1U);
  EXPECT_EQ(p.steps.front().pass, Pass::ToneMap);
  EXPECT_THAT(p.leftOut, names("every pass"));
}

TEST_F(FramePlanTest, BuffersThatNeverMeetShareMemory) {
  look.mutable_smoothing()->mutable_bilateral();
  scene::complete(look);
  more = {traits};
  const FramePlan p = plan();
  // The first liquid's scratch is done with before the second's is begun.
  const PictureBuffer* const scratch = p.buffer(Resource::SurfaceScratch, 0);
  const PictureBuffer* const second = p.buffer(Resource::SurfaceScratch, 1);
  ASSERT_NE(scratch, nullptr);
  ASSERT_NE(second, nullptr);
  EXPECT_TRUE(scratch->sharedWith || second->sharedWith);
  EXPECT_LE(scratch->bytes() + second->bytes(), 4U * 640 * 480);
  // What is kept for the next frame shares with nobody.
  EXPECT_FALSE(p.buffer(Resource::Background)->sharedWith);
  EXPECT_FALSE(p.buffer(Resource::Surface)->sharedWith);
}

TEST_F(FramePlanTest, SunlightNeedsASunAboveTheHorizon) {
  EXPECT_TRUE(plan().runs(Pass::Sunlight));
  sun.set_strength(0);
  EXPECT_FALSE(plan().runs(Pass::Sunlight));
  sun.set_strength(1);
  sun.mutable_direction()->set_y(-0.5);
  EXPECT_FALSE(plan().runs(Pass::Sunlight));
}

TEST_F(FramePlanTest, ShadowNeedsFloorAndStrength) {
  background.set_floor(false);
  EXPECT_FALSE(plan().runs(Pass::Sunlight));
  background.set_floor(true);
  sun.set_shadow(0);
  const FramePlan p = plan();
  EXPECT_FALSE(p.runs(Pass::Sunlight));
  EXPECT_EQ(p.buffer(Resource::Scene), nullptr);
}

TEST_F(FramePlanTest, SaysWhyThereIsNoSunlight) {
  EXPECT_EQ(whyNot("sunlight"), "");
  background.set_floor(false);
  EXPECT_EQ(whyNot("sunlight"), "there is no floor, nor a body, that it could fall on");
  background.set_floor(true);
  sun.set_shadow(0);
  EXPECT_EQ(whyNot("sunlight"), "lighting.sun.shadow is 0");
  sun.mutable_direction()->set_y(0);
  EXPECT_EQ(whyNot("sunlight"), "the sun is at the horizon or below");
  sun.set_strength(0);
  EXPECT_EQ(whyNot("sunlight"), "lighting.sun.strength is 0");
  traits.points = 0;
  EXPECT_EQ(whyNot("sunlight"), "no liquid is in the picture");
}

TEST_F(FramePlanTest, SaysWhyThereAreNoCaustics) {
  EXPECT_EQ(whyNot("caustics"), "");
  look.mutable_liquid()->set_refractive_index(1);
  EXPECT_EQ(whyNot("caustics"), "no liquid lets light through and refracts it");
  look.mutable_liquid()->set_refractive_index(1.333);
  look.mutable_liquid()->set_opaque(true);
  EXPECT_EQ(whyNot("caustics"), "no liquid lets light through and refracts it");
  more = {traits};  // takes `look`
  EXPECT_EQ(whyNot("caustics"), "no liquid lets light through and refracts it");
  *scene.add_more_looks() = look;
  scene.mutable_more_looks(0)->mutable_liquid()->set_opaque(false);
  EXPECT_EQ(whyNot("caustics"), "") << "the second does";
  sun.set_caustics(0);
  EXPECT_EQ(whyNot("caustics"), "lighting.sun.caustics is 0");
  EXPECT_TRUE(plan().runs(Pass::Sunlight)) << "for the shadow";
}

TEST_F(FramePlanTest, SaysWhyNothingIsMirrored) {
  EXPECT_EQ(whyNot("reflection"), "");
  background.mutable_backdrop();
  EXPECT_EQ(whyNot("reflection"), "a backdrop is not mirrored");
  look.mutable_liquid()->mutable_no_reflection();
  EXPECT_EQ(whyNot("reflection"), "look.liquid.no_reflection is chosen");
  background.mutable_sky();
  EXPECT_EQ(whyNot("reflection"), "look.liquid.no_reflection is chosen");
}

TEST_F(FramePlanTest, LargeSplatsHaveTheirOwnPasses) {
  EXPECT_FALSE(plan().runs(Pass::LargeSplats));
  traits.largeSplats = 3;
  EXPECT_TRUE(plan().runs(Pass::LargeSplats));
  EXPECT_TRUE(plan().runs(Pass::LargeThickness));
}

TEST_F(FramePlanTest, SprayIsDrawnLastWhereThereIsAny) {
  const auto reason = [&] { return whyNot("spray"); };
  EXPECT_EQ(reason(), "the source gives no densities");
  traits.densities = true;
  EXPECT_EQ(reason(), "no particle in the picture is far from the rest");
  look.mutable_splats()->set_stray_density(0);
  EXPECT_EQ(reason(), "look.splats.stray_density is 0");
  look.mutable_splats()->set_stray_density(0.4);
  traits.sprayDrops = 3;
  look.mutable_smoothing()->set_divisor(2);
  EXPECT_EQ(reason(), "");
  const FramePlan p = plan();
  const PassStep& spray = p.steps[p.steps.size() - 2];
  EXPECT_EQ(spray.pass, Pass::Spray);
  EXPECT_THAT(spray.reads, Contains(BufferId{Resource::Surface}));
  EXPECT_EQ(p.steps.back().pass, Pass::ToneMap);
}

TEST_F(FramePlanTest, SprayAloneNeedsNoLiquid) {
  traits.points = 0;
  traits.sprayDrops = 3;
  const FramePlan p = plan();
  EXPECT_TRUE(p.runs(Pass::Spray));
  EXPECT_TRUE(p.runs(Pass::Sunlight));
  EXPECT_FALSE(p.runs(Pass::Splats));
  EXPECT_EQ(p.buffer(Resource::Surface), nullptr);
  EXPECT_NE(p.buffer(Resource::Picture), nullptr);
  EXPECT_THAT(p.leftOut, names("liquid"));
}

TEST_F(FramePlanTest, InteriorParticlesNeedNeighbourCountsAndClosedSplats) {
  EXPECT_THAT(plan().leftOut, names("search for interior particles"));
  traits.neighbourCounts = true;
  EXPECT_THAT(plan().leftOut, Not(names("search for interior particles")));
  look.mutable_splats()->set_radius_in_spacings(0.6);
  EXPECT_THAT(plan().leftOut, names("search for interior particles"));
  look.mutable_splats()->set_radius_in_spacings(0.9);
  look.mutable_splats()->set_skip_interior(false);
  EXPECT_THAT(plan().leftOut, names("search for interior particles"));
}

TEST_F(FramePlanTest, OneLiquidHasNoLayers) {
  const FramePlan p = plan();
  EXPECT_EQ(p.layers, 1);
  EXPECT_FALSE(p.runs(Pass::ExtendScene));
  EXPECT_EQ(p.buffer(Resource::Surface, 1), nullptr);
  EXPECT_THAT(p.leftOut, names("extend scene"));
  // A second that is not in the picture changes nothing but what is said of it.
  more.emplace_back();
  EXPECT_EQ(plan().steps, p.steps);
  EXPECT_EQ(plan().buffers, p.buffers);
}

TEST_F(FramePlanTest, EveryLiquidIsCompositedInEveryLayer) {
  more = {traits};
  const FramePlan p = plan();
  EXPECT_EQ(p.layers, 2);
  EXPECT_EQ(std::ranges::count(p.steps, Pass::Composite, &PassStep::pass), 4);
  EXPECT_EQ(std::ranges::count(p.steps, Pass::Layers, &PassStep::pass), 2);
  EXPECT_EQ(std::ranges::count(p.steps, Pass::ExtendScene, &PassStep::pass), 1);
  EXPECT_NE(p.buffer(Resource::Surface, 1), nullptr);
  EXPECT_NE(p.buffer(Resource::Scene), nullptr);
}

TEST_F(FramePlanTest, HighlightOfStrengthZeroIsLeftOut) {
  look.mutable_liquid()->mutable_physical()->set_specular(0);
  EXPECT_THAT(plan().leftOut, names("specular highlight"));
}

TEST_F(FramePlanTest, BackSurfaceIsForTwoInterfacesOfClearLiquidAlone) {
  EXPECT_EQ(plan().buffer(Resource::BackSurface), nullptr);
  EXPECT_THAT(plan().leftOut, names("back splats"));
  look.mutable_liquid()->mutable_two_interfaces();
  EXPECT_TRUE(plan().runs(Pass::BackSplats));
  EXPECT_TRUE(plan().runs(Pass::BackSmoothing));
  EXPECT_NE(plan().buffer(Resource::BackSurface), nullptr);
  look.mutable_smoothing()->set_time(0);
  EXPECT_FALSE(plan().runs(Pass::BackSmoothing));
  look.mutable_liquid()->mutable_metal();
  EXPECT_EQ(plan().buffer(Resource::BackSurface), nullptr);
  EXPECT_EQ(plan().buffer(Resource::Thickness), nullptr);
  EXPECT_THAT(plan().leftOut, names("refraction"));
}

TEST_F(FramePlanTest, TheCpuDrawsTheBackAtHalfTheSize) {
  look.mutable_liquid()->mutable_two_interfaces();
  ASSERT_NE(plan().buffer(Resource::BackCoarse), nullptr);
  EXPECT_EQ(plan().buffer(Resource::BackCoarse)->size, (core::ImageSize{320, 240}));
  EXPECT_EQ(plan().buffer(Resource::BackSurface)->size, (core::ImageSize{640, 480}));
  EXPECT_EQ(plan().surfaces[0].backDivisor, 2U);
  look.mutable_smoothing()->set_divisor(2);
  EXPECT_EQ(plan().buffer(Resource::BackCoarse), nullptr) << "the surface is as coarse";
  EXPECT_EQ(plan().surfaces[0].backDivisor, 2U);
  look.mutable_smoothing()->set_divisor(1);
  look.mutable_smoothing()->mutable_bilateral();
  scene::complete(look);
  EXPECT_EQ(plan().buffer(Resource::BackCoarse), nullptr) << "it is smoothed in buffers of the surface's size";
  look.mutable_smoothing()->mutable_implicit_curvature_flow();
  scene::complete(look);
  look.mutable_smoothing()->set_time(0);
  EXPECT_EQ(plan().buffer(Resource::BackCoarse), nullptr) << "it is not smoothed";
}

TEST_F(FramePlanTest, ThicknessDivisorShrinksItsBuffer) {
  look.mutable_thickness()->set_divisor(4);
  EXPECT_EQ(plan().buffer(Resource::Thickness)->size, (core::ImageSize{160, 120}));
  EXPECT_EQ(plan().buffer(Resource::Thickness)->bytes(), 160U * 120U * 4U);
}

TEST_F(FramePlanTest, FlowStaysBelowItsBoundAndReachesItsTime) {
  look.mutable_smoothing()->set_time(0.5);
  look.mutable_smoothing()->mutable_curvature_flow()->set_max_iterations(10000);
  scene::complete(look);
  const FlowSchedule flow = plan().surfaces[0].flow;
  const double footprint = traits.pixelSlope * traits.nearestDepth;
  EXPECT_LE(flow.stepTime, 0.9 * footprint * footprint / 2);
  EXPECT_NEAR(flow.iterations * flow.stepTime, 0.5 * traits.spacing * traits.spacing, 1e-12);
  EXPECT_EQ(flow.shortfall, 0);
}

TEST_F(FramePlanTest, FlowCutShortSaysSo) {
  look.mutable_smoothing()->set_time(50);
  look.mutable_smoothing()->mutable_curvature_flow()->set_max_iterations(10);
  scene::complete(look);
  const FramePlan p = plan();
  EXPECT_EQ(p.surfaces[0].flow.iterations, 10);
  EXPECT_GT(p.surfaces[0].flow.shortfall, 0.5);
  EXPECT_THAT(p.leftOut, Contains(Field(&core::LeftOut::reason, "max_iterations is reached")));
}

}  // namespace
}  // namespace sluice::render
