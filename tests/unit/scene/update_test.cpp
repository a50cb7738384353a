#include <gmock/gmock.h>

#include "support.h"

namespace sluice::scene::test {
namespace {

using google::protobuf::FieldMask;

FieldMask maskOf(std::initializer_list<const char*> paths) {
  FieldMask mask;
  for (const char* path : paths) mask.add_paths(path);
  return mask;
}

TEST(Update, TakesOnlyWhatTheMaskNames) {
  v1::Scene partial;
  partial.mutable_look()->mutable_smoothing()->set_time(3);
  partial.mutable_look()->mutable_liquid()->mutable_physical()->set_specular(0);
  const Update update = applyUpdate(smallScene(), partial, maskOf({"look.smoothing.time"}));
  EXPECT_EQ(update.scene.look().smoothing().time(), 3);
  EXPECT_EQ(update.scene.look().liquid().physical().specular(), 1);
  EXPECT_FALSE(update.restart);
}

TEST(Update, FollowsIndices) {
  v1::Scene partial;
  partial.mutable_simulation()->add_fluids()->set_viscosity(0.5);
  const Update update = applyUpdate(smallScene(), partial, maskOf({"simulation.fluids[0].viscosity"}));
  EXPECT_EQ(update.scene.simulation().fluids(0).viscosity(), 0.5);
  EXPECT_EQ(update.scene.simulation().fluids(0).blocks_size(), 1);
  EXPECT_FALSE(update.restart);
}

TEST(Update, SetsBackWhatThePartialSceneDoesNotGive) {
  v1::Scene scene = smallScene();
  scene.mutable_playback()->set_speed(3);
  const Update update = applyUpdate(scene, {}, maskOf({"playback.speed"}));
  EXPECT_EQ(update.scene.playback().speed(), 1);
}

TEST(Update, RestartsForAFieldThatNeedsIt) {
  v1::Scene partial;
  partial.mutable_simulation()->set_particle_spacing(0.1);
  EXPECT_TRUE(applyUpdate(smallScene(), partial, maskOf({"simulation.particle_spacing"})).restart);
  v1::Scene block;
  block.mutable_simulation()->add_fluids()->add_blocks()->set_count_y(5);
  EXPECT_TRUE(applyUpdate(smallScene(), block, maskOf({"simulation.fluids[0].blocks[0].count_y"})).restart);
  v1::Scene corner;
  corner.mutable_simulation()->mutable_container()->mutable_max()->set_x(3);
  EXPECT_TRUE(applyUpdate(smallScene(), corner, maskOf({"simulation.container.max.x"})).restart);
}

TEST(Update, DoesNotRestartForAnEqualValue) {
  v1::Scene partial;
  partial.mutable_simulation()->set_particle_spacing(smallScene().simulation().particle_spacing());
  EXPECT_FALSE(applyUpdate(smallScene(), partial, maskOf({"simulation.particle_spacing"})).restart);
}

TEST(Update, DoesNotRestartForAnotherLook) {
  v1::Scene scene = smallScene();
  scene.mutable_look()->mutable_smoothing()->mutable_curvature_flow();
  v1::Scene partial;
  partial.mutable_look()->mutable_smoothing()->mutable_bilateral();
  const Update update = applyUpdate(scene, partial, maskOf({"look.smoothing.bilateral"}));
  EXPECT_TRUE(update.scene.look().smoothing().has_bilateral());
  EXPECT_TRUE(update.scene.look().smoothing().bilateral().has_depth_deviation_in_radii());
  EXPECT_FALSE(update.restart);
}

TEST(Update, RestartsForAnotherSource) {
  v1::Scene partial;
  partial.mutable_column_and_sheet()->set_particles(10);
  const Update update = applyUpdate(smallScene(), partial, maskOf({"column_and_sheet"}));
  EXPECT_FALSE(update.scene.has_simulation());
  EXPECT_TRUE(update.restart);
}

TEST(Update, ReplacesWholeLists) {
  v1::Scene partial;
  v1::Fluid& fluid = *partial.mutable_simulation()->add_fluids();
  for (int i = 0; i < 3; ++i) fluid.add_blocks()->mutable_first_particle();
  const Update update = applyUpdate(smallScene(), partial, maskOf({"simulation.fluids[0].blocks"}));
  EXPECT_EQ(update.scene.simulation().fluids(0).blocks_size(), 3);
  EXPECT_TRUE(update.restart);
}

TEST(Update, IsRefusedAsAWhole) {
  v1::Scene partial;
  partial.mutable_look()->mutable_smoothing()->set_time(-3);
  const auto error = inputError([&] { applyUpdate(smallScene(), partial, maskOf({"look.smoothing.time", "title"})); });
  EXPECT_EQ(error.fieldPath(), "look.smoothing.time");
}

TEST(Update, RefusesMasksThatNameNothing) {
  EXPECT_THROW(applyUpdate(smallScene(), {}, {}), core::InputError);
  EXPECT_THROW(applyUpdate(smallScene(), {}, maskOf({""})), core::InputError);
  EXPECT_THROW(applyUpdate(smallScene(), {}, maskOf({"look.wibble"})), core::InputError);
}

TEST(Update, RefusesAnIndexThatOneSideLacks) {
  EXPECT_THROW(applyUpdate(smallScene(), {}, maskOf({"simulation.fluids[0].viscosity"})), core::InputError);
  v1::Scene two;
  two.mutable_simulation()->add_fluids();
  two.mutable_simulation()->add_fluids()->set_viscosity(1);
  EXPECT_THROW(applyUpdate(smallScene(), two, maskOf({"simulation.fluids[1].viscosity"})), core::InputError);
}

TEST(Update, RefusesToClearWhatIsRequired) {
  const auto error = inputError([] { applyUpdate(smallScene(), {}, maskOf({"simulation.container"})); });
  EXPECT_EQ(error.fieldPath(), "simulation.container.min");
}

}  // namespace
}  // namespace sluice::scene::test
