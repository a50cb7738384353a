#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "running_service.h"

namespace sluice::test {
namespace {

using ::testing::HasSubstr;

/// Sends a request that has to be granted, and returns the first Stats at that number of steps. Stats overtake and are
/// overtaken by replies, so those of an earlier state may come in between.
v1::Stats statsAfter(TestViewer& viewer, const v1::ClientMessage& message, std::uint64_t steps) {
  const std::uint64_t sequence = viewer.send(message);
  bool granted = false;
  std::optional<v1::Stats> stats;
  while (!granted || !stats) {
    const v1::ServerMessage received = viewer.receive();
    if (received.has_stats() && received.stats().steps() == steps) stats = received.stats();
    if (received.in_reply_to() == sequence) {
      EXPECT_TRUE(received.has_done()) << received.ShortDebugString();
      granted = true;
    }
  }
  return *stats;
}

TEST(ServiceScene, TellsWhatRunsOnArrival) {
  RunningService service;
  TestViewer viewer("127.0.0.1", service.port());
  const v1::Welcome welcome = viewer.hello();
  EXPECT_EQ(welcome.protocol_version(), 1U);
  EXPECT_TRUE(welcome.paused());
  EXPECT_FALSE(welcome.renderer().empty());
  EXPECT_DOUBLE_EQ(welcome.scene().simulation().particle_spacing(), 0.05);
  EXPECT_TRUE(welcome.scene().look().smoothing().has_time()) << "defaults are filled in";
  bool hasDefaultScene = false;
  for (const v1::SceneEntry& entry : welcome.scenes()) hasDefaultScene |= entry.name() == "dam_break";
  EXPECT_TRUE(hasDefaultScene);
  EXPECT_EQ(viewer.receive(v1::ServerMessage::kStats).stats().particles(), 8U * 8U * 9U);
}

TEST(ServiceScene, LiveParameterChangesThePictureAndTellsEveryone) {
  RunningService service;
  TestViewer ann = service.viewer();
  TestViewer bob = service.viewer();
  ann.setView(160, 120, {v1::PNG});
  const v1::Frame before = ann.nextFrame();
  const std::uint64_t sequence =
      ann.send(updateMessage("look { liquid { absorption { x: 20 y: 2 z: 2 } } }", {"look.liquid.absorption"}));
  const v1::Frame after = ann.frameReflecting(sequence);
  EXPECT_NE(before.payload(), after.payload());
  EXPECT_EQ(after.simulation_time(), before.simulation_time());

  const v1::SceneChanged told = bob.receive(v1::ServerMessage::kSceneChanged).scene_changed();
  EXPECT_DOUBLE_EQ(told.scene().look().liquid().absorption().x(), 20);
  EXPECT_FALSE(told.restarted());
}

TEST(ServiceScene, OutOfRangeIsRefusedByFieldPathAndChangesNothing) {
  RunningService service;
  TestViewer viewer = service.viewer();
  // The first of the two fields is fine: all or none.
  const v1::ServerMessage answer = viewer.receiveReply(
      viewer.send(updateMessage("look { smoothing { time: 2 } } simulation { fluids { viscosity: -1 } }",
                                {"look.smoothing.time", "simulation.fluids[0].viscosity"})));
  ASSERT_TRUE(answer.has_error()) << answer.ShortDebugString();
  EXPECT_EQ(answer.error().code(), v1::Error::INVALID);
  EXPECT_EQ(answer.error().field_path(), "simulation.fluids[0].viscosity");
  EXPECT_THAT(answer.error().message(), HasSubstr("-1"));

  TestViewer another("127.0.0.1", service.port());
  const v1::Scene scene = another.hello().scene();
  EXPECT_DOUBLE_EQ(scene.simulation().fluids(0).viscosity(), 0.01);
  EXPECT_EQ(scene.look().smoothing().time(), v1::Smoothing().time());
}

TEST(ServiceScene, UnknownFieldIsRefused) {
  RunningService service;
  TestViewer viewer = service.viewer();
  const v1::ServerMessage answer =
      viewer.receiveReply(viewer.send(updateMessage("", {"look.smoothing.no_such_field"})));
  ASSERT_TRUE(answer.has_error());
  EXPECT_THAT(answer.error().field_path(), HasSubstr("no_such_field"));
}

TEST(ServiceScene, StepsOneByOneAndReturnsToTheStart) {
  RunningService service;
  TestViewer viewer = service.viewer();
  const v1::Stats one = statsAfter(viewer, controlMessage(v1::Control::STEP), 1);
  EXPECT_GT(one.simulation_time(), 0);
  EXPECT_TRUE(one.paused());
  EXPECT_FALSE(one.time_step_limit().empty());
  const v1::Stats two = statsAfter(viewer, controlMessage(v1::Control::STEP), 2);
  EXPECT_GT(two.simulation_time(), one.simulation_time());
  EXPECT_EQ(statsAfter(viewer, controlMessage(v1::Control::RESET), 0).simulation_time(), 0);
}

TEST(ServiceScene, RestartParameterStartsAgain) {
  RunningService service;
  TestViewer viewer = service.viewer();
  statsAfter(viewer, controlMessage(v1::Control::STEP), 1);
  viewer.send(updateMessage("simulation { particle_spacing: 0.025 }", {"simulation.particle_spacing"}));
  const v1::SceneChanged told = viewer.receive(v1::ServerMessage::kSceneChanged).scene_changed();
  EXPECT_TRUE(told.restarted());
  // Stats of the state before may still be under way.
  while (viewer.receive(v1::ServerMessage::kStats).stats().simulation_time() > 0) {
  }
}

TEST(ServiceScene, ImpossibleRestartKeepsWhatRuns) {
  RunningService service;
  TestViewer viewer = service.viewer();
  statsAfter(viewer, controlMessage(v1::Control::STEP), 1);
  // In range field by field, but the block no longer fits into the container.
  const v1::ServerMessage answer = viewer.receiveReply(viewer.send(
      updateMessage("simulation { fluids { blocks { count_x: 500 } } }", {"simulation.fluids[0].blocks[0].count_x"})));
  ASSERT_TRUE(answer.has_error()) << answer.ShortDebugString();
  EXPECT_THAT(answer.error().field_path(), HasSubstr("simulation.fluids[0].blocks[0]"));
  statsAfter(viewer, controlMessage(v1::Control::STEP), 2);  // the simulation goes on
}

TEST(ServiceScene, LoadsShippedScenesAndRefusesOthers) {
  RunningService service;
  TestViewer viewer = service.viewer();
  v1::ClientMessage load;
  load.mutable_load_scene()->set_name("atlantis");
  const v1::ServerMessage refused = viewer.receiveReply(viewer.send(load));
  ASSERT_TRUE(refused.has_error());
  EXPECT_THAT(refused.error().message(), HasSubstr("dam_break")) << "the names there are";

  load.mutable_load_scene()->set_name("dam_break");
  viewer.send(load);
  const v1::SceneChanged told = viewer.receive(v1::ServerMessage::kSceneChanged).scene_changed();
  EXPECT_EQ(told.scene_name(), "dam_break");
}

TEST(ServiceScene, RefusesBadSceneTextWithItsPlace) {
  RunningService service;
  TestViewer viewer = service.viewer();
  v1::ClientMessage load;
  load.mutable_load_scene()->set_text("title: \"x\"\nsimulation {\n  particle_spacin: 0.1\n}\n");
  const v1::ServerMessage answer = viewer.receiveReply(viewer.send(load));
  ASSERT_TRUE(answer.has_error());
  EXPECT_THAT(answer.error().message(), HasSubstr("scene:3:"));
}

TEST(ServiceScene, ViewersCannotReadTheServersFiles) {
  RunningService service;
  TestViewer viewer = service.viewer();
  v1::ClientMessage load;
  load.mutable_load_scene()->set_text("particle_file { path: \"/etc/passwd\" }");
  const v1::ServerMessage loaded = viewer.receiveReply(viewer.send(load));
  ASSERT_TRUE(loaded.has_error());
  EXPECT_EQ(loaded.error().field_path(), "particle_file.path");

  const v1::ServerMessage updated =
      viewer.receiveReply(viewer.send(updateMessage("particle_file { path: \"/etc/passwd\" }", {"particle_file"})));
  ASSERT_TRUE(updated.has_error());

  const v1::ServerMessage body =
      viewer.receiveReply(viewer.send(updateMessage("bodies { mesh { path: \"/etc/shape.obj\" } }", {"bodies"})));
  ASSERT_TRUE(body.has_error());
  EXPECT_EQ(body.error().field_path(), "bodies[0].mesh.path");

  const v1::ServerMessage sky = viewer.receiveReply(viewer.send(
      updateMessage("background { environment_map { path: \"/etc/sky.hdr\" } }", {"background.environment_map"})));
  ASSERT_TRUE(sky.has_error());
  EXPECT_EQ(sky.error().field_path(), "background.environment_map.path");
}

}  // namespace
}  // namespace sluice::test
