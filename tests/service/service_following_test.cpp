// Several viewers of one picture, stills, picking and steps to a time: what the service promises beyond a single
// stream.
#include <chrono>
#include <vector>

#include <gtest/gtest.h>

#include "running_service.h"

namespace sluice::test {
namespace {

using namespace std::chrono_literals;

/// Follows another viewer, with JPEG.
std::uint64_t follow(TestViewer& viewer, std::uint64_t leader) {
  v1::ClientMessage message;
  v1::SetView& view = *message.mutable_set_view();
  view.set_width(64);
  view.set_height(64);
  view.set_follow(leader);
  view.set_no_still(true);
  return viewer.send(message);
}

TEST(ServiceFollowing, SixteenFollowersCostOneEncoding) {
  stream::ServerOptions options;
  options.maxViewers = 32;
  options.maxViewersPerAddress = 32;
  RunningService service(kSmallScene, options);
  TestViewer leader("127.0.0.1", service.port());
  const std::uint64_t id = leader.hello().viewer_id();
  v1::ClientMessage view;
  view.mutable_set_view()->set_width(160);
  view.mutable_set_view()->set_height(120);
  view.mutable_set_view()->set_no_still(true);
  leader.send(view);
  leader.nextFrame();

  std::vector<TestViewer> followers;
  for (int k = 0; k < 16; ++k) {
    followers.push_back(service.viewer());
    follow(followers.back(), id);
    const v1::Frame frame = followers.back().nextFrame();
    EXPECT_EQ(frame.width(), 160U) << "the leader's size";
  }
  const double encoded = metric(service.port(), "sluice_frames_encoded_total");
  const double sent = metric(service.port(), "sluice_frames_sent_total");
  constexpr int kCameras = 5;
  for (int k = 0; k < kCameras; ++k) {
    const v1::Frame shown = leader.frameReflecting(leader.setCamera(cameraAt(1.5, 0.9, 1.7 + 0.05 * k)));
    for (TestViewer& follower : followers) EXPECT_EQ(follower.nextFrame().payload(), shown.payload());
  }
  EXPECT_EQ(metric(service.port(), "sluice_frames_encoded_total") - encoded, kCameras);
  EXPECT_EQ(metric(service.port(), "sluice_frames_sent_total") - sent, kCameras * 17);
}

TEST(ServiceFollowing, ViewersHearOfEachOther) {
  RunningService service;
  TestViewer ann("127.0.0.1", service.port());
  const std::uint64_t annsId = ann.hello("Ann").viewer_id();
  TestViewer bob = service.viewer();
  ann.setView(64, 48);
  v1::ViewersChanged told;
  while (told.viewers_size() != 2 || told.viewers(0).width() == 0) {
    told = bob.receive(v1::ServerMessage::kViewersChanged).viewers_changed();
  }
  EXPECT_EQ(told.viewers(0).viewer_id(), annsId);
  EXPECT_EQ(told.viewers(0).client(), "Ann");
  EXPECT_EQ(told.viewers(0).height(), 48U);
  follow(bob, annsId);
  while (told.viewers(1).follows() != annsId) {
    told = ann.receive(v1::ServerMessage::kViewersChanged).viewers_changed();
  }
  ann.close();
  while (told.viewers_size() != 1) told = bob.receive(v1::ServerMessage::kViewersChanged).viewers_changed();
  EXPECT_EQ(told.viewers(0).follows(), 0U);
}

TEST(ServiceFollowing, FollowingNobodyIsRefused) {
  RunningService service;
  TestViewer viewer = service.viewer();
  const v1::ServerMessage answer = viewer.receiveReply(follow(viewer, 99));
  EXPECT_EQ(answer.error().code(), v1::Error::INVALID);
  EXPECT_EQ(answer.error().field_path(), "set_view.follow");
}

TEST(ServiceStill, ALosslessPictureComesAtRest) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(160, 120, {v1::JPEG}, 30);
  v1::Frame frame = viewer.nextFrame();
  EXPECT_EQ(frame.codec(), v1::JPEG);
  EXPECT_EQ(frame.quality(), 30U);
  while (!frame.still()) frame = viewer.nextFrame();
  EXPECT_EQ(frame.codec(), v1::PNG);
  v1::ClientMessage request;
  request.mutable_snapshot()->set_width(160);
  request.mutable_snapshot()->set_height(120);
  const v1::ServerMessage snapshot = viewer.receiveReply(viewer.send(request));
  EXPECT_EQ(decodePng(frame.payload()).rgb, decodePng(snapshot.frame().payload()).rgb);
  EXPECT_FALSE(viewer.tryReceive(800ms)) << "one still is enough";
}

TEST(ServicePick, FindsTheBlock) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(160, 120);
  viewer.nextFrame();
  v1::ClientMessage request;
  request.mutable_pick()->set_x(0.5);
  request.mutable_pick()->set_y(0.5);
  // Along −x, through the middle of the block.
  *request.mutable_pick()->mutable_camera() = cameraAt(3, 0.3, 0.25);
  request.mutable_pick()->mutable_camera()->mutable_target()->set_y(0.3);
  request.mutable_pick()->mutable_camera()->mutable_target()->set_z(0.25);
  const v1::ServerMessage answer = viewer.receiveReply(viewer.send(request));
  ASSERT_TRUE(answer.has_picked()) << answer.ShortDebugString();
  EXPECT_TRUE(answer.picked().hit());
  EXPECT_NEAR(answer.picked().position().y(), 0.3, 0.01);
  EXPECT_NEAR(answer.picked().depth(), 3 - answer.picked().position().x(), 0.01);
  EXPECT_NEAR(answer.picked().thickness(), 8 * 0.05, 0.02) << "eight layers";
  EXPECT_NEAR(answer.picked().density(), 1000, 250);

  request.mutable_pick()->set_x(0);
  request.mutable_pick()->set_y(0);
  EXPECT_FALSE(viewer.receiveReply(viewer.send(request)).picked().hit());
}

/// Pushes along −x through the middle of the block, from a camera to its right.
v1::ClientMessage push(double strength) {
  v1::ClientMessage message;
  v1::Interact& interact = *message.mutable_interact();
  interact.set_action(v1::Interact::PUSH);
  interact.mutable_origin()->set_x(3);
  interact.mutable_origin()->set_y(0.3);
  interact.mutable_origin()->set_z(0.25);
  interact.mutable_direction()->set_x(-1);
  interact.set_strength(strength);
  return message;
}

TEST(ServiceTouch, APushMovesTheFluid) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  viewer.nextFrame();
  EXPECT_TRUE(viewer.receiveReply(viewer.send(push(300))).has_done());
  EXPECT_TRUE(viewer.receiveReply(viewer.send(controlMessage(v1::Control::STEP, 0.03))).has_done());
  v1::ClientMessage pick;
  pick.mutable_pick()->set_x(0.5);
  pick.mutable_pick()->set_y(0.5);
  *pick.mutable_pick()->mutable_camera() = cameraAt(3, 0.3, 0.25);
  pick.mutable_pick()->mutable_camera()->mutable_target()->set_y(0.3);
  pick.mutable_pick()->mutable_camera()->mutable_target()->set_z(0.25);
  EXPECT_LT(viewer.receiveReply(viewer.send(pick)).picked().velocity().x(), -0.2);
}

TEST(ServiceTouch, SpectatorsOnlyLook) {
  RunningService service;
  TestViewer viewer("127.0.0.1", service.port());
  viewer.helloAs(v1::SPECTATOR);
  EXPECT_EQ(viewer.receiveReply(viewer.send(push(300))).error().code(), v1::Error::REFUSED);
}

TEST(ServiceStep, GoesToATimeExactly) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  viewer.nextFrame();
  for (const double until : {0.04, 0.08, 0.1}) {
    EXPECT_TRUE(viewer.receiveReply(viewer.send(controlMessage(v1::Control::STEP, until))).has_done());
    double shown = -1;
    while (shown != until) shown = viewer.nextFrame().simulation_time();
  }
  const v1::ServerMessage past = viewer.receiveReply(viewer.send(controlMessage(v1::Control::STEP, 0.05)));
  EXPECT_TRUE(past.has_done()) << "it is reached already";
}

TEST(ServiceStep, AnotherCommandEndsIt) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  const std::uint64_t step = viewer.send(controlMessage(v1::Control::STEP, 1e6));
  viewer.send(controlMessage(v1::Control::PAUSE));
  const v1::ServerMessage answer = viewer.receiveReply(step);
  EXPECT_TRUE(answer.has_error()) << answer.ShortDebugString();
}

}  // namespace
}  // namespace sluice::test
