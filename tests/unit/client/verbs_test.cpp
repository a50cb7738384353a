// Verbs that ask and steer, against a fake server: what they send, what they print, and how they end.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_client.h"

namespace sluice::client {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Info, TellsWhatRuns) {
  const FakeServer server(oblige);
  const Outcome text = run(server, {"info"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  for (const char* part : {"0.1.0", "a renderer", "dam_break: A dam breaks", "1234", "paused at 1.5 s, 300 steps",
                           "1920x1080", "JPEG PNG", "* dam_break"}) {
    EXPECT_THAT(text.out, HasSubstr(part));
  }
  const Json json = run(server, {"--json", "info"}).json();
  EXPECT_EQ(json["renderer"], "a renderer");
  EXPECT_EQ(json["particles"], 1234);
  EXPECT_EQ(json["paused"], true);
  EXPECT_EQ(json["stats"]["steps"], 300);
  EXPECT_EQ(json["codecs"], Json({"JPEG", "PNG"}));
  EXPECT_EQ(json["scenes"][0]["name"], "dam_break");
  EXPECT_EQ(json["scene"]["camera"]["eye"]["x"], 3);
}

TEST(Set, SendsOneUpdateOfAll) {
  const FakeServer server(oblige);
  const Outcome outcome = run(server, {"set", "look.smoothing.time=2", "camera.eye=-1,2,3", "--json"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["changed"], Json({"look.smoothing.time", "camera.eye"}));
  ASSERT_EQ(server.received().size(), 2U);
  const v1::UpdateScene update = server.received()[1].update_scene();
  EXPECT_THAT(update.mask().paths(), ElementsAre("look.smoothing.time", "camera.eye"));
  EXPECT_EQ(update.scene().camera().eye().x(), -1);
}

TEST(Set, PassesOnTheServersRefusal) {
  const FakeServer server(refuse);
  const Outcome outcome = run(server, {"set", "look.smoothing.time=99"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(outcome.err, "sluice: look.smoothing.time: 99 is outside [0, 50] d²\n");
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST(Camera, ShowsAndChangesWhereViewersStart) {
  const FakeServer server(oblige);
  EXPECT_EQ(run(server, {"camera"}).out, "--eye 3,0,0 --target 0,1,0 --up 0,1,0 --fov 45\n");
  EXPECT_EQ(server.received().size(), 1U) << "showing changes nothing";
  const Outcome outcome = run(server, {"camera", "--eye", "-1,2,3", "--fov", "30", "--json"});
  EXPECT_EQ(outcome.json()["eye"], Json({-1.0, 2.0, 3.0}));
  EXPECT_EQ(outcome.json()["target"], Json({0.0, 1.0, 0.0}));
  EXPECT_EQ(outcome.json()["vertical_fov_degrees"], 30);
  EXPECT_THAT(server.received().back().update_scene().mask().paths(),
              ElementsAre("camera.eye", "camera.vertical_fov_degrees"));
}

TEST(Controls, SendTheirActionAndTellTheState) {
  const FakeServer server(oblige);
  for (const auto& [verb, action] : {std::pair("play", v1::Control::PLAY), std::pair("pause", v1::Control::PAUSE),
                                     std::pair("step", v1::Control::STEP), std::pair("reset", v1::Control::RESET)}) {
    const Outcome outcome = run(server, {verb});
    EXPECT_EQ(outcome.out, "paused at 1.5 s, 300 steps\n") << outcome.err;
    const std::vector<v1::ClientMessage> received = server.received();
    // Hello, the action, the Ping behind it.
    EXPECT_EQ(received[received.size() - 2].control().action(), action) << verb;
  }
  EXPECT_EQ(run(server, {"pause", "--json"}).json()["paused"], true);
}

TEST(Controls, StepsUntilATime) {
  const FakeServer server(oblige);
  EXPECT_EQ(run(server, {"step", "--until", "1.5"}).exitCode, 0);
  ASSERT_EQ(server.received().size(), 3U);
  EXPECT_EQ(server.received()[1].control().action(), v1::Control::STEP);
  EXPECT_EQ(server.received()[1].control().until_seconds(), 1.5);
}

TEST(Controls, StepRepeatsItself) {
  const FakeServer server(oblige);
  EXPECT_EQ(run(server, {"step", "5"}).exitCode, 0);
  EXPECT_EQ(server.received().size(), 1U + 5U + 1U);
}

/// Tells who is there, as soon as somebody comes.
Reaction tellViewers(const v1::ClientMessage& message) {
  Reaction reaction = oblige(message);
  if (!message.has_hello()) return reaction;
  reaction.messages.back().mutable_welcome()->set_viewer_id(7);
  v1::ServerMessage told;
  for (const std::uint64_t id : {3U, 7U}) {
    v1::ViewersChanged::Viewer& viewer = *told.mutable_viewers_changed()->add_viewers();
    viewer.set_viewer_id(id);
    viewer.set_client("program " + std::to_string(id));
    viewer.set_role(id == 3 ? v1::DRIVER : v1::SPECTATOR);
    viewer.set_width(id == 3 ? 640 : 0);
    viewer.set_height(id == 3 ? 480 : 0);
    viewer.set_follows(id == 3 ? 0 : 3);
  }
  reaction.messages.push_back(told);
  return reaction;
}

TEST(Viewers, ListsWhoLooksOn) {
  const FakeServer server(tellViewers);
  const Json json = run(server, {"viewers", "--json"}).json();
  ASSERT_EQ(json["viewers"].size(), 2U);
  EXPECT_EQ(json["viewers"][0]["role"], "driver");
  EXPECT_TRUE(json["viewers"][0]["follows"].is_null());
  EXPECT_EQ(json["viewers"][1]["follows"], 3);
  EXPECT_EQ(json["viewers"][1]["self"], true);
  EXPECT_THAT(run(server, {"viewers"}).out, AllOf(HasSubstr("640x480"), HasSubstr("* 7"), HasSubstr("program 3")));
}

}  // namespace
}  // namespace sluice::client
