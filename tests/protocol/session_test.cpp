// The conversation between a viewer and a server that both behave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "live_server.h"

namespace sluice::stream::test {
namespace {

using sluice::test::ConnectionEnded;
using sluice::test::TestViewer;
using testing::StartsWith;

v1::Camera cameraAt(double x) {
  v1::Camera camera;
  camera.mutable_eye()->set_x(x);
  return camera;
}

TEST(LiveSession, WelcomeTellsTheLimitsAndTheViewerItsNumber) {
  const LiveServer server({.maxSize = {800, 600}, .maxMessageBytes = 4096, .maxRate = 30});
  TestViewer first = server.connect();
  TestViewer second = server.connect();
  const v1::Welcome welcome = first.hello();
  EXPECT_EQ(welcome.protocol_version(), 1U);
  EXPECT_EQ(welcome.limits().max_width(), 800U);
  EXPECT_EQ(welcome.limits().max_height(), 600U);
  EXPECT_EQ(welcome.limits().max_message_bytes(), 4096U);
  EXPECT_EQ(welcome.limits().frame_window(), 2U);
  EXPECT_EQ(welcome.limits().max_rate(), 30);
  EXPECT_NE(welcome.viewer_id(), second.hello().viewer_id());
}

TEST(LiveSession, FramesComeAfterSetViewAndNotBefore) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  EXPECT_FALSE(viewer.tryReceive(std::chrono::milliseconds(100))) << "something came before SetView";

  const std::uint64_t view = viewer.setView(320, 200, {v1::PNG});
  for (std::uint64_t id = 1; id <= 20; ++id) {
    const v1::Frame frame = viewer.nextFrame();
    EXPECT_EQ(frame.frame_id(), id);
    EXPECT_EQ(frame.width(), 320U);
    EXPECT_EQ(frame.height(), 200U);
    EXPECT_EQ(frame.codec(), v1::PNG);
    EXPECT_TRUE(frame.keyframe());
    EXPECT_EQ(frame.reflects_sequence(), view);
    EXPECT_EQ(frame.payload().size(), 1000U);
    EXPECT_THAT(frame.payload(), StartsWith(FakeBackend::payloadFor(core::Camera{}.eye.x())));
    ASSERT_EQ(frame.stages_size(), 2);
    EXPECT_EQ(frame.stages(1).name(), "encode");
    EXPECT_EQ(frame.stages(1).milliseconds(), 2.0);
  }
}

TEST(LiveSession, CameraChangesThePicture) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  viewer.setView(320, 200);
  viewer.nextFrame();
  const v1::Frame frame = viewer.frameReflecting(viewer.setCamera(cameraAt(7.25)));
  EXPECT_THAT(frame.payload(), StartsWith(FakeBackend::payloadFor(7.25F)));
}

TEST(LiveSession, CameraOutOfRangeIsRefusedByItsFieldAndChangesNothing) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  v1::Camera camera = cameraAt(7.25);
  camera.set_vertical_fov_degrees(200);
  const std::uint64_t refused = viewer.setCamera(camera);
  const v1::ServerMessage answer = viewer.receiveReply(refused);
  ASSERT_TRUE(answer.has_error()) << answer.ShortDebugString();
  EXPECT_EQ(answer.error().code(), v1::Error::INVALID);
  EXPECT_EQ(answer.error().field_path(), "camera.vertical_fov_degrees");

  const std::uint64_t view = viewer.setView(320, 200);
  const v1::Frame frame = viewer.nextFrame();
  EXPECT_EQ(frame.reflects_sequence(), view);
  EXPECT_THAT(frame.payload(), StartsWith(FakeBackend::payloadFor(core::Camera{}.eye.x())));
}

TEST(LiveSession, RefusedSceneUpdateNamesTheField) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  v1::ClientMessage message;
  v1::UpdateScene& update = *message.mutable_update_scene();
  update.mutable_scene()->mutable_look()->mutable_smoothing()->set_time(99);
  update.mutable_mask()->add_paths("look.smoothing.time");
  const v1::ServerMessage answer = viewer.receiveReply(viewer.send(message));
  EXPECT_EQ(answer.error().code(), v1::Error::INVALID);
  EXPECT_EQ(answer.error().field_path(), "look.smoothing.time");
}

TEST(LiveSession, SceneChangeReachesEveryViewer) {
  const LiveServer server;
  TestViewer driver = server.connect();
  TestViewer watcher = server.connect();
  driver.hello();
  watcher.hello();
  v1::ClientMessage message;
  v1::UpdateScene& update = *message.mutable_update_scene();
  update.mutable_scene()->mutable_look()->mutable_smoothing()->set_time(3);
  update.mutable_mask()->add_paths("look.smoothing.time");
  const std::uint64_t sequence = driver.send(message);
  EXPECT_TRUE(driver.receiveReply(sequence).has_done());
  const v1::ServerMessage changed = watcher.receive(v1::ServerMessage::kSceneChanged);
  EXPECT_EQ(changed.scene_changed().scene().look().smoothing().time(), 3);
  EXPECT_EQ(changed.in_reply_to(), 0U);
}

TEST(LiveSession, SnapshotStandsOutsideTheWindow) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  viewer.setView(320, 200);
  // Fill the window.
  viewer.nextFrame(/*acknowledged=*/false);
  viewer.nextFrame(/*acknowledged=*/false);
  v1::ClientMessage message;
  message.mutable_snapshot()->set_width(64);
  message.mutable_snapshot()->set_height(32);
  const v1::ServerMessage answer = viewer.receiveReply(viewer.send(message));
  ASSERT_TRUE(answer.has_frame()) << answer.ShortDebugString();
  EXPECT_TRUE(answer.frame().snapshot());
  EXPECT_EQ(answer.frame().width(), 64U);
}

TEST(LiveSession, PongReturnsTheViewersTime) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  v1::ClientMessage message;
  message.mutable_ping()->set_client_time(1234.5);
  const v1::ServerMessage answer = viewer.receiveReply(viewer.send(message));
  EXPECT_EQ(answer.pong().client_time(), 1234.5);
}

TEST(LiveSession, ViewerComesBackAfterClosing) {
  LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  viewer.setView(320, 200);
  viewer.nextFrame();
  viewer.close();
  EXPECT_TRUE(server.backend.waitForLeft(1));

  viewer.connect("127.0.0.1", server.port());
  viewer.hello();
  viewer.setView(320, 200);
  EXPECT_EQ(viewer.nextFrame().frame_id(), 1U);
}

TEST(LiveSession, StopSendsACloseFrameWithTheReason) {
  LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  std::thread stopping([&] { server.stop("the server restarts"); });
  const ConnectionEnded end = viewer.waitForEnd();
  stopping.join();
  EXPECT_EQ(end.code, 1001);
  EXPECT_EQ(end.reason, "the server restarts");
  EXPECT_EQ(server.backend.counts().left, 1);
}

}  // namespace
}  // namespace sluice::stream::test
