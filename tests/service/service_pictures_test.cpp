#include <gtest/gtest.h>

#include "running_service.h"

namespace sluice::test {
namespace {

TEST(ServicePictures, ArriveInTheSizeAndCodecAsked) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(320, 200, {v1::PNG});
  const v1::Frame frame = viewer.nextFrame();
  EXPECT_EQ(frame.codec(), v1::PNG);
  const Picture picture = decodePng(frame.payload());
  EXPECT_EQ(picture.width, 320);
  EXPECT_EQ(picture.height, 200);
  EXPECT_GT(picture.colours(), 100U) << "a blank picture";

  const v1::Frame jpeg = viewer.frameReflecting(viewer.setView(161, 99, {v1::JPEG}));
  EXPECT_EQ(jpeg.codec(), v1::JPEG);
  EXPECT_EQ(jpeg.payload().substr(0, 2), "\xFF\xD8");
  EXPECT_EQ(jpeg.width(), 161U);
  EXPECT_EQ(jpeg.height(), 99U);
}

TEST(ServicePictures, CarryTheTimesOfTheirStages) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  const v1::Frame frame = viewer.nextFrame();
  ASSERT_GE(frame.stages_size(), 3);
  EXPECT_EQ(frame.stages(frame.stages_size() - 1).name(), "encode");
}

TEST(ServicePictures, FollowTheCameraAndNothingElse) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(240, 180, {v1::PNG});
  const Picture front = decodePng(viewer.frameReflecting(viewer.setCamera(cameraAt(1.5, 0.9, 1.6))).payload());
  const Picture side = decodePng(viewer.frameReflecting(viewer.setCamera(cameraAt(-1.2, 0.9, 1.6))).payload());
  EXPECT_GT(front.differingShare(side), 0.2);
  const Picture again = decodePng(viewer.frameReflecting(viewer.setCamera(cameraAt(1.5, 0.9, 1.6))).payload());
  EXPECT_EQ(front.differingShare(again), 0) << "the scene rests, so the same camera gives the same picture";
}

TEST(ServicePictures, ComeOnlyWhenSomethingChanged) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  viewer.nextFrame();
  for (auto message = viewer.tryReceive(std::chrono::milliseconds(300)); message;
       message = viewer.tryReceive(std::chrono::milliseconds(300))) {
    EXPECT_TRUE(!message->has_frame() || message->frame().still()) << "nothing moved";
  }
}

TEST(ServicePictures, EachViewerHasItsOwnCameraAndSize) {
  RunningService service;
  TestViewer ann = service.viewer();
  TestViewer bob = service.viewer();
  ann.setView(200, 100, {v1::PNG});
  bob.setView(100, 200, {v1::PNG});
  const v1::Frame anns = ann.frameReflecting(ann.setCamera(cameraAt(1.5, 0.9, 1.6)));
  const v1::Frame bobs = bob.frameReflecting(bob.setCamera(cameraAt(-1.5, 0.4, 1.2)));
  EXPECT_EQ(anns.width(), 200U);
  EXPECT_EQ(bobs.width(), 100U);
  const v1::Frame annsNext = ann.frameReflecting(ann.setCamera(cameraAt(1.5, 0.9, 1.6)));
  EXPECT_EQ(anns.payload(), annsNext.payload()) << "another viewer's camera moved this one's";
}

TEST(ServicePictures, MoveWhileTheScenePlays) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(160, 120, {v1::PNG});
  const v1::Frame first = viewer.nextFrame();
  viewer.send(controlMessage(v1::Control::PLAY));
  v1::Frame later = viewer.nextFrame();
  while (later.simulation_time() < 0.05) later = viewer.nextFrame();
  EXPECT_GT(later.snapshot_sequence(), first.snapshot_sequence());
  EXPECT_NE(later.payload(), first.payload());
}

TEST(ServicePictures, SnapshotsAreLosslessAndOutsideTheWindow) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  viewer.nextFrame(false);  // never acknowledged
  v1::ClientMessage request;
  request.mutable_snapshot()->set_width(300);
  request.mutable_snapshot()->set_height(150);
  *request.mutable_snapshot()->mutable_camera() = cameraAt(1.5, 0.9, 1.6);
  const v1::ServerMessage answer = viewer.receiveReply(viewer.send(request));
  ASSERT_TRUE(answer.has_frame()) << answer.ShortDebugString();
  EXPECT_TRUE(answer.frame().snapshot());
  EXPECT_EQ(answer.frame().codec(), v1::PNG);
  EXPECT_EQ(decodePng(answer.frame().payload()).width, 300);
}

}  // namespace
}  // namespace sluice::test
