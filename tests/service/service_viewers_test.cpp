#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "running_service.h"

namespace sluice::test {
namespace {

TEST(ServiceViewers, OneThatStopsReadingDisturbsNoOther) {
  RunningService service;
  TestViewer silent = service.viewer();
  silent.setView(320, 240, {v1::PNG});
  TestViewer lively = service.viewer();
  lively.setView(160, 120, {v1::PNG});
  lively.send(controlMessage(v1::Control::PLAY));
  std::uint64_t lastFrame = 0;
  for (int k = 0; k < 30; ++k) lastFrame = lively.nextFrame().frame_id();
  EXPECT_GE(lastFrame, 30U);
}

TEST(ServiceViewers, OneThatNeverAcknowledgesGetsTheWindowAlone) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  viewer.nextFrame(/*acknowledged=*/false);
  int frames = 1;
  for (int k = 1; k <= 20; ++k) {
    const std::uint64_t sequence = viewer.setCamera(cameraAt(1.5, 0.9, 1.6 + 0.01 * k));
    v1::ClientMessage ping;
    ping.mutable_ping();
    const std::uint64_t pinged = viewer.send(ping);
    ASSERT_GT(pinged, sequence);
    for (auto message = viewer.tryReceive(std::chrono::milliseconds(50)); message;
         message = viewer.tryReceive(std::chrono::milliseconds(50))) {
      frames += message->has_frame() ? 1 : 0;
    }
  }
  EXPECT_EQ(frames, 2);
}

TEST(ServiceViewers, MalformedBytesEndOneConnectionAlone) {
  RunningService service;
  TestViewer vandal = service.viewer();
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  viewer.nextFrame();
  vandal.sendBinary("\xFF\xFF\xFF\xFF\xFF");
  EXPECT_EQ(vandal.waitForEnd().code, 1007);
  viewer.frameReflecting(viewer.setCamera(cameraAt(1.4, 0.9, 1.6)));
}

TEST(ServiceViewers, VanishingMidStreamLeavesTheOthers) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  viewer.send(controlMessage(v1::Control::PLAY));
  for (int k = 0; k < 5; ++k) {
    TestViewer passing = service.viewer();
    passing.setView(200 + k, 100, {v1::PNG});
    passing.nextFrame();
    passing.vanish();
    viewer.nextFrame();
  }
  viewer.nextFrame();
}

/// The simulated time that a viewer finds who comes and leaves at once, s.
double timeFoundBy(RunningService& service) {
  TestViewer viewer("127.0.0.1", service.port());
  viewer.hello();
  const double time = viewer.receive(v1::ServerMessage::kStats).stats().simulation_time();
  viewer.close();
  return time;
}

TEST(ServiceViewers, TimeRestsWhileNobodyWatches) {
  RunningService service;
  {
    TestViewer viewer = service.viewer();
    viewer.send(controlMessage(v1::Control::PLAY));
    viewer.setView(64, 64);
    while (viewer.nextFrame().simulation_time() < 0.02) {
    }
    viewer.close();
  }
  // The server may hear late that a viewer has left: the first pauses may still see it run.
  constexpr int kPauses = 10;
  double shortest = std::numeric_limits<double>::infinity();
  double before = timeFoundBy(service);
  for (int pause = 0; pause < kPauses && shortest >= 0.15; ++pause) {
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    const double after = timeFoundBy(service);
    shortest = std::min(shortest, after - before);
    before = after;
  }
  EXPECT_LT(shortest, 0.15) << "400 ms without a viewer, and the scene went on";
}

/// The next plan that is drawn by, while frames are acknowledged.
v1::PlanChanged nextPlan(TestViewer& viewer) {
  for (;;) {
    const v1::ServerMessage message = viewer.receive();
    if (message.has_frame()) viewer.acknowledge(message.frame().frame_id());
    if (message.has_plan_changed()) return message.plan_changed();
  }
}

bool leavesOut(const v1::Plan& plan, const std::string& name) {
  return std::any_of(plan.left_out().begin(), plan.left_out().end(),
                     [&](const v1::Plan::LeftOut& entry) { return entry.name() == name && !entry.reason().empty(); });
}

TEST(ServiceViewers, PlanTellsWhatIsLeftOut) {
  RunningService service;
  TestViewer viewer = service.viewer();
  viewer.setView(64, 64);
  const v1::PlanChanged plan = nextPlan(viewer);
  EXPECT_GT(plan.frame().stages_size(), 3);
  EXPECT_GT(plan.steps().stages_size(), 3);
  EXPECT_FALSE(leavesOut(plan.frame(), "thickness"));

  viewer.send(updateMessage("look { liquid { opaque: true } }", {"look.liquid.opaque"}));
  while (!leavesOut(nextPlan(viewer).frame(), "thickness")) {
  }
}

}  // namespace
}  // namespace sluice::test
