// What viewers ask of a scene, written down and done again.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "running_service.h"
#include "sluice/app/command_log.h"
#include "sluice/core/input_error.h"

namespace sluice::test {
namespace {

namespace fs = std::filesystem;

/// From above, into the middle of the small scene's fluid.
v1::ClientMessage interactMessage(v1::Interact::Action action) {
  v1::ClientMessage message;
  v1::Interact& interact = *message.mutable_interact();
  interact.set_action(action);
  interact.mutable_origin()->set_x(0.22);
  interact.mutable_origin()->set_y(2);
  interact.mutable_origin()->set_z(0.25);
  interact.mutable_direction()->set_y(-2);
  interact.set_radius(0.1);
  return message;
}

class CommandLogTest : public testing::Test {
 protected:
  CommandLogTest() : file_(fs::path(testing::TempDir()) / (std::string("commands_") + testName() + ".log")) {
    fs::remove(file_);
  }
  ~CommandLogTest() override { fs::remove(file_); }

  static std::string testName() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

  /// A run in which viewers change viscosity and gravity while it plays, step it and start it again.
  void record() {
    app::SceneRunnerOptions runner;
    runner.commandLog = file_;
    RunningService service(kSmallScene, {}, runner);
    TestViewer viewer = service.viewer();
    viewer.setView(64, 64);
    const auto granted = [&](const v1::ClientMessage& message) {
      EXPECT_TRUE(viewer.receiveReply(viewer.send(message)).has_done());
    };
    granted(controlMessage(v1::Control::PLAY));
    double time = 0;
    while (time < 0.05) time = viewer.nextFrame().simulation_time();
    granted(updateMessage("simulation { fluids { viscosity: 0.2 } }", {"simulation.fluids[0].viscosity"}));
    while (time < 0.1) time = viewer.nextFrame().simulation_time();
    granted(updateMessage("simulation { gravity { x: 5 } }", {"simulation.gravity.x"}));
    granted(controlMessage(v1::Control::STEP, 0.2));
    granted(controlMessage(v1::Control::STEP));
    granted(controlMessage(v1::Control::RESET));
    granted(controlMessage(v1::Control::STEP, 0.07));
    granted(updateMessage("simulation { gravity { y: -3 } }", {"simulation.gravity.y"}));
    for (const auto action : {v1::Interact::PUSH, v1::Interact::PULL, v1::Interact::ADD}) {
      granted(interactMessage(action));
    }
    granted(controlMessage(v1::Control::STEP, 0.12));
  }

  fs::path file_;
};

TEST_F(CommandLogTest, ReplayReachesTheSameParticlesBitForBit) {
  record();
  for (const int threads : {1, 3}) {
    const app::Replay replayed = app::replay(app::readCommandLog(file_), threads);
    ASSERT_TRUE(replayed.same);
    EXPECT_TRUE(*replayed.same) << threads << " threads";
    EXPECT_EQ(replayed.run->source().time(), 0.12);
    EXPECT_DOUBLE_EQ(replayed.run->scene()->scene.simulation().gravity().y(), -3);
  }
}

TEST_F(CommandLogTest, ATouchThatIsLeftOutIsNoticed) {
  record();
  app::RecordedRun run = app::readCommandLog(file_);
  const std::size_t before = run.entries.size();
  std::erase_if(run.entries, [](const v1::CommandLogEntry& entry) { return entry.has_interact(); });
  EXPECT_EQ(run.entries.size(), before - 3);
  EXPECT_EQ(app::replay(run, 2).same, false);
}

TEST_F(CommandLogTest, AChangedCommandIsNoticed) {
  record();
  app::RecordedRun run = app::readCommandLog(file_);
  for (v1::CommandLogEntry& entry : run.entries) {
    if (entry.update_scene().scene().simulation().gravity().has_y()) {
      entry.mutable_update_scene()->mutable_scene()->mutable_simulation()->mutable_gravity()->set_y(-3.001);
    }
  }
  EXPECT_EQ(app::replay(run, 2).same, false);
}

TEST_F(CommandLogTest, OneThatIsCutOffIsDoneAsFarAsItGoes) {
  record();
  const std::size_t entries = app::readCommandLog(file_).entries.size();
  fs::resize_file(file_, fs::file_size(file_) - 3);
  const app::RecordedRun run = app::readCommandLog(file_);
  EXPECT_EQ(run.entries.size(), entries - 1);
  EXPECT_FALSE(app::replay(run, 2).same);
}

TEST_F(CommandLogTest, WhatIsNoLogIsRefused) {
  std::ofstream(file_) << "pool of water";
  EXPECT_THROW(app::readCommandLog(file_), core::InputError);
  EXPECT_THROW(app::readCommandLog("/nowhere/commands.log"), core::InputError);
}

}  // namespace
}  // namespace sluice::test
