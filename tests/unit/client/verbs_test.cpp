// Every verb against a fake server: what it sends, what it prints, and how it ends.

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_server.h"
#include "print_json.h"
#include "sluice/client/command_line.h"
#include "sluice/client/json.h"
#include "test_pictures.h"

namespace sluice::client {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

struct Outcome {
  int exitCode = 0;
  std::string out;
  std::string err;

  Json json() const {
    const std::string lines = out.substr(0, out.find_last_not_of('\n') + 1);
    return Json::parse(lines.substr(lines.rfind('\n') + 1));
  }
};

Outcome run(std::vector<std::string> arguments, bool terminal = false) {
  std::ostringstream out;
  std::ostringstream err;
  const int exitCode = runCommandLine(arguments, {out, err, terminal});
  return {exitCode, out.str(), err.str()};
}

Outcome run(const FakeServer& server, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--server", server.url().text(), "--timeout", "20"});
  return run(std::move(arguments));
}

/// Refuses everything but to greet.
Reaction refuse(const v1::ClientMessage& message) {
  if (message.has_hello()) return oblige(message);
  v1::ServerMessage reply = replyTo(message);
  reply.mutable_error()->set_field_path("look.smoothing.time");
  reply.mutable_error()->set_message("99 is outside [0, 50] d²");
  return {.messages = {reply}};
}

/// Answers a snapshot request with this picture.
FakeServer::React picturing(v1::Codec codec, std::string payload) {
  return [codec, payload](const v1::ClientMessage& message) {
    if (!message.has_snapshot()) return oblige(message);
    v1::ServerMessage reply = replyTo(message);
    v1::Frame& frame = *reply.mutable_frame();
    frame.set_snapshot(true);
    frame.set_codec(codec);
    frame.set_width(message.snapshot().width());
    frame.set_height(message.snapshot().height());
    frame.set_payload(payload);
    return Reaction{.messages = {reply}};
  };
}

/// Streams JPEG pictures: one for each view or camera, each reflecting it.
Reaction stream(const v1::ClientMessage& message) {
  if (!message.has_set_view() && !message.has_set_camera()) {
    return message.has_frame_ack() ? Reaction() : oblige(message);
  }
  v1::ServerMessage reply;
  v1::Frame& frame = *reply.mutable_frame();
  frame.set_frame_id(message.sequence());
  frame.set_reflects_sequence(message.sequence());
  frame.set_codec(v1::JPEG);
  frame.set_width(32);
  frame.set_height(16);
  frame.set_payload(jpegOf(32, 16, 0x204060));
  v1::StageTime& stage = *frame.add_stages();
  stage.set_name("composite");
  stage.set_milliseconds(2.5);
  return {.messages = {reply}};
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "sluice_client_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string contents(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(CommandLine, BadUsageIsTwo) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {},
           {"dance"},
           {"info", "--loud"},
           {"set"},
           {"set", "look.smoothing.tim=1"},
           {"step", "0"},
           {"step", "many"},
           {"load", "./no_such_file.textproto"},
           {"snapshot"},
           {"snapshot", "f.png", "--size", "big"},
           {"snapshot", "f.png", "--camera", "here"},
           {"watch", "--count", "0"},
           {"bench", "--codec", "gif"},
           {"bench", "--still", "--orbit"},
           {"bench", "--still", "--in-turn"},
           {"script", "no_such_file"},
           {"info", "--server", "ftp://host"},
           {"info", "--timeout", "-1"},
           {"info", "--token", "two words"},
           {"info", "--token-file", "no_such_file"},
           {"info", "--server", "wss://127.0.0.1:1", "--ca-file", "no_such_file"},
           {"watch", "--follow", "0"},
           {"step", "2", "--until", "1"},
           {"pick", "0.5"},
           {"pick", "0.5,1.5"},
           {"push", "0.5,0.5", "--seconds", "2"},
           {"add"},
       }) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.err, StartsWith("sluice: "));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
  EXPECT_THAT(run({"dance"}).err, AllOf(HasSubstr("'dance'"), HasSubstr("info, set, camera")));
}

TEST(CommandLine, HelpIsNoFailure) {
  EXPECT_EQ(run({"--help"}).exitCode, 0);
  EXPECT_THAT(run({"bench", "--help"}).out, HasSubstr("--quality"));
}

TEST(CommandLine, NoServerIsThree) {
  std::string address;
  {
    const FakeServer gone(oblige);
    address = gone.url().text();
  }
  for (const char* verb : {"info", "play", "watch", "bench", "camera"}) {
    const Outcome outcome = run({verb, "--server", address});
    EXPECT_EQ(outcome.exitCode, 3) << verb;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("cannot connect to " + address), HasSubstr("refused")));
  }
}

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

TEST(Access, TellsTheRoleAndTheTokenInTheHandshakeAlone) {
  const FakeServer server(oblige);
  EXPECT_EQ(run(server, {"info", "--spectator", "--token", "a-secret-of-many-letters"}).exitCode, 0);
  EXPECT_EQ(server.received()[0].hello().role(), v1::SPECTATOR);
  EXPECT_THAT(server.received()[0].hello().token(), IsEmpty());
  EXPECT_EQ(server.authorization(), "Bearer a-secret-of-many-letters");
  const TemporaryFolder folder;
  std::ofstream(folder.file("tokens")) << "of-the-drivers-0123\r\nof-the-spectators\n";
  EXPECT_EQ(run(server, {"info", "--token-file", folder.file("tokens")}).exitCode, 0);
  EXPECT_EQ(server.authorization(), "Bearer of-the-drivers-0123");
}

TEST(Access, TokensAreNotPrinted) {
  const std::string token = "a-secret-of-many-letters";
  const Outcome refused = run(FakeServer(401), {"info", "--token", token});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("401"), HasSubstr("--token-file")));
  const Outcome misspelt = run({"info", "--token", token + " and-more"});
  for (const Outcome& outcome : {refused, misspelt}) EXPECT_EQ(outcome.err.find(token), std::string::npos);
}

TEST(Interactions, SendTheLineOfSight) {
  const FakeServer server(oblige);
  const std::string camera = "0,0,2:0,0,0:90";
  const Outcome outcome = run(server, {"push", "1,0.5", "--camera", camera, "--size", "200x100", "--radius", "0.2",
                                       "--strength", "12", "--seconds", "0.5", "--json"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const v1::Interact push = server.received().back().interact();
  EXPECT_EQ(push.action(), v1::Interact::PUSH);
  EXPECT_EQ(push.origin().z(), 2);
  // At the right edge tan 45° · 200/100 = 2 to the right for each 1 forwards.
  EXPECT_NEAR(push.direction().x(), 2 / std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(push.direction().y(), 0, 1e-9);
  EXPECT_NEAR(push.direction().z(), -1 / std::sqrt(5.0), 1e-9);
  EXPECT_EQ(push.radius(), 0.2);
  EXPECT_EQ(push.strength(), 12);
  EXPECT_EQ(push.seconds(), 0.5);

  EXPECT_EQ(run(server, {"add", "0.5,0.5", "--fluid", "1"}).exitCode, 0);
  EXPECT_EQ(server.received().back().interact().action(), v1::Interact::ADD);
  EXPECT_EQ(server.received().back().interact().fluid(), 1U);
  EXPECT_EQ(server.received().back().interact().origin().x(), 3) << "the scene's camera";
  EXPECT_EQ(run(server, {"pull", "0.5,0.5"}).exitCode, 0);
  EXPECT_EQ(server.received().back().interact().action(), v1::Interact::PULL);
  EXPECT_EQ(run(FakeServer(refuse), {"pull", "0.5,0.5"}).exitCode, 1);
}

Reaction answerPick(const v1::ClientMessage& message, bool hit) {
  if (!message.has_pick()) return oblige(message);
  v1::ServerMessage reply = replyTo(message);
  v1::Picked& picked = *reply.mutable_picked();
  picked.set_hit(hit);
  picked.mutable_position()->set_y(0.25);
  picked.set_depth(3);
  picked.set_thickness(0.5);
  picked.set_density(1000);
  return {.messages = {reply}};
}

TEST(Pick, TellsWhatIsThere) {
  const FakeServer server([](const v1::ClientMessage& message) { return answerPick(message, true); });
  const Json json = run(server, {"pick", "0.25,0.75", "--size", "320x200", "--json"}).json();
  EXPECT_EQ(json["hit"], true);
  EXPECT_EQ(json["position"], Json({0.0, 0.25, 0.0}));
  EXPECT_EQ(json["depth"], 3);
  EXPECT_EQ(json["thickness"], 0.5);
  EXPECT_EQ(json["density"], 1000);
  const std::vector<v1::ClientMessage> received = server.received();
  EXPECT_EQ(received[1].set_view().width(), 320U) << "the picture that is picked from";
  EXPECT_EQ(received[2].pick().x(), 0.25);
  EXPECT_EQ(received[2].pick().y(), 0.75);
  EXPECT_EQ(received[2].pick().camera().eye().x(), 3);
  EXPECT_THAT(run(server, {"pick", "0.5,0.5"}).out, AllOf(HasSubstr("0, 0.25, 0 m"), HasSubstr("1000 kg")));
}

TEST(Pick, ThereMayBeNothing) {
  const FakeServer server([](const v1::ClientMessage& message) { return answerPick(message, false); });
  const Json json = run(server, {"pick", "0.5,0.5", "--json"}).json();
  EXPECT_EQ(json["hit"], false);
  EXPECT_TRUE(json["position"].is_null());
  EXPECT_EQ(run(server, {"pick", "0.5,0.5"}).out, "no fluid there\n");
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

TEST(Controls, StepRepeatsItself) {
  const FakeServer server(oblige);
  EXPECT_EQ(run(server, {"step", "5"}).exitCode, 0);
  EXPECT_EQ(server.received().size(), 1U + 5U + 1U);
}

TEST(Load, SendsNamesAsNamesAndFilesAsText) {
  const FakeServer server(oblige);
  EXPECT_EQ(run(server, {"load", "dam_break"}).exitCode, 0);
  EXPECT_EQ(server.received()[1].load_scene().name(), "dam_break");

  const TemporaryFolder folder;
  std::ofstream(folder.file("own.textproto")) << "title: \"mine\"";
  const Outcome outcome = run(server, {"load", folder.file("own.textproto"), "--json"});
  EXPECT_EQ(outcome.json()["particles"], 1234);
  const std::vector<v1::ClientMessage> received = server.received();
  EXPECT_EQ(received[received.size() - 2].load_scene().text(), "title: \"mine\"");
}

TEST(Load, RefusesFilesTheServerWouldNotTake) {
  const FakeServer server(oblige);
  const TemporaryFolder folder;
  std::ofstream(folder.file("long.textproto")) << std::string(2U << 20U, '#');
  const Outcome outcome = run(server, {"load", folder.file("long.textproto")});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, HasSubstr("at most 1048576"));
}

TEST(Snapshot, StoresThePayloadAsItIs) {
  const std::string png = pngOf(8, 4, 0x808080);
  const FakeServer server(picturing(v1::PNG, png));
  const TemporaryFolder folder;
  const std::string file = folder.file("f.png");
  const Outcome outcome = run(server, {"snapshot", file, "--size", "8x4", "--camera", "1,2,3:0,0,0:60", "--json"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(contents(file), png);
  EXPECT_EQ(outcome.json()["width"], 8);
  EXPECT_EQ(outcome.json()["bytes"], png.size());
  const v1::SnapshotRequest asked = server.received()[1].snapshot();
  EXPECT_EQ(asked.camera().vertical_fov_degrees(), 60);
  EXPECT_EQ(asked.camera().up().y(), 1) << "the camera that is sent is complete";
}

TEST(Snapshot, LeavesTheOldFileWhenRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.file("f.png");
  std::ofstream(file) << "precious";
  EXPECT_EQ(run(FakeServer(refuse), {"snapshot", file}).exitCode, 1);
  const Outcome lossy = run(FakeServer(picturing(v1::JPEG, "...")), {"snapshot", file});
  EXPECT_EQ(lossy.exitCode, 1);
  EXPECT_THAT(lossy.err, HasSubstr("JPEG"));
  EXPECT_EQ(contents(file), "precious");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.file("")), {}), 1) << "nothing else is left";
}

TEST(Snapshot, AsksForNothingThatItCannotStore) {
  const FakeServer server(oblige);
  const TemporaryFolder folder;
  for (const std::string& place : {folder.file("no/such/folder/f.png"), folder.file("")}) {
    const Outcome outcome = run(server, {"snapshot", place});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr(place));
  }
  EXPECT_TRUE(server.received().empty());
}

/// Tells its state once to each viewer, then closes.
Reaction tellOnceAndClose(const v1::ClientMessage& message) {
  Reaction reaction = oblige(message);
  v1::ServerMessage stats;
  *stats.mutable_stats() = someStats();
  reaction.messages.push_back(stats);
  reaction.close = true;
  return reaction;
}

TEST(Watch, ConnectsAgainWhenTheServerGoesAway) {
  const FakeServer server(tellOnceAndClose);
  const Outcome outcome = run(server, {"watch", "--count", "2", "--json"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("has ended"), HasSubstr("connected again")));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2);
  EXPECT_EQ(outcome.json()["steps"], 300);
  EXPECT_EQ(server.received().size(), 2U);
}

TEST(Watch, EndsWithTheServerWhereAskedTo) {
  const FakeServer server(tellOnceAndClose);
  const Outcome outcome = run(server, {"watch", "--no-reconnect"});
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_THAT(outcome.err, HasSubstr("has ended"));
  EXPECT_EQ(server.received().size(), 1U);
}

TEST(Watch, FollowsAViewersPictures) {
  const FakeServer server([](const v1::ClientMessage& message) {
    Reaction reaction = stream(message);
    if (message.has_frame_ack()) {
      reaction.messages.emplace_back();
      *reaction.messages.back().mutable_stats() = someStats();
    }
    return reaction;
  });
  const Json json = run(server, {"watch", "--follow", "3", "--count", "1", "--json"}).json();
  EXPECT_EQ(json["pictures"]["frames"], 1);
  EXPECT_EQ(json["pictures"]["width"], 32);
  EXPECT_GT(json["pictures"]["bytes"], 0);
  EXPECT_EQ(server.received()[1].set_view().follow(), 3U);
  EXPECT_EQ(server.received()[2].frame_ack().frame_id(), server.received()[1].sequence());
}

TEST(Watch, WritesPlainLinesUnlessOnATerminal) {
  const FakeServer server(tellOnceAndClose);
  const std::vector<std::string> arguments = {"watch", "--count", "2", "--server", server.url().text()};
  const std::string lines = run(arguments, /*terminal=*/false).out;
  EXPECT_THAT(lines, StartsWith("time_s"));
  EXPECT_EQ(lines.find('\x1b'), std::string::npos);
  const std::string table = run(arguments, /*terminal=*/true).out;
  EXPECT_THAT(table, AllOf(HasSubstr("\x1b["), HasSubstr("1.500 s after 300 steps")));
}

TEST(Bench, ReportsTheAgreedFigures) {
  const FakeServer server(stream);
  const Outcome outcome = run(server, {"bench", "--seconds", "0.3", "--size", "32x16", "--quality", "70", "--json"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json json = outcome.json();
  EXPECT_GT(json["input_to_decoded_ms"]["median"], 0);
  EXPECT_GE(json["input_to_decoded_ms"]["p95"], json["input_to_decoded_ms"]["median"]);
  EXPECT_GE(json["input_to_decoded_ms"]["p99"], json["input_to_decoded_ms"]["p95"]);
  EXPECT_GT(json["frames"], 0);
  EXPECT_NEAR(json["frames_per_second"].get<double>() * json["seconds"].get<double>(), json["frames"], 1e-6);
  EXPECT_GT(json["kilobytes_per_second"], 0);
  EXPECT_EQ(json["stages"]["composite"], 2.5);
  const v1::SetView view = server.received()[1].set_view();
  EXPECT_EQ(view.width(), 32U);
  EXPECT_EQ(view.quality(), 70U);
  EXPECT_THAT(view.codecs(), ElementsAre(v1::JPEG));
}

TEST(Bench, AcknowledgesEveryFrameOnceDecoded) {
  const FakeServer server(stream);
  ASSERT_EQ(run(server, {"bench", "--seconds", "0.2", "--size", "32x16"}).exitCode, 0);
  std::vector<std::uint64_t> asked;
  std::vector<std::uint64_t> acknowledged;
  for (const v1::ClientMessage& message : server.received()) {
    if (message.has_set_view() || message.has_set_camera()) asked.push_back(message.sequence());
    if (message.has_frame_ack()) acknowledged.push_back(message.frame_ack().frame_id());
  }
  EXPECT_GT(asked.size(), 1U);
  EXPECT_EQ(acknowledged, asked);
}

TEST(Bench, InTurnSendsACameraForEveryPictureAndNoMore) {
  const FakeServer server(stream);
  const Json json = run(server, {"bench", "--seconds", "0.2", "--size", "32x16", "--in-turn", "--json"}).json();
  EXPECT_GT(json["inputs"], 12) << "more than sixty a second, as pictures come at once";
  EXPECT_EQ(json["longest_delay_frames"], 1);
  EXPECT_EQ(json["draw_ms"]["median"], 2.5);
  EXPECT_NEAR(json["beside_drawing_ms"]["median"].get<double>(),
              json["input_to_decoded_ms"]["median"].get<double>() - 2.5, 1e-9);
}

TEST(Bench, WithTheCameraAtRestMeasuresNoDelay) {
  const FakeServer server(stream);
  const Json json = run(server, {"bench", "--seconds", "0.1", "--size", "32x16", "--still", "--json"}).json();
  EXPECT_TRUE(json["input_to_decoded_ms"]["median"].is_null());
  EXPECT_EQ(json["inputs"], 0);
  EXPECT_EQ(json["frames"], 0) << "the one frame of the view itself warms up";
}

TEST(Bench, PassesOnTheServersRefusal) {
  const Outcome outcome = run(FakeServer(refuse), {"bench", "--seconds", "0.1"});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.err, HasSubstr("99 is outside"));
}

TEST(Script, RunsLinesUpToTheFirstThatFails) {
  const FakeServer server(oblige);
  const TemporaryFolder folder;
  std::ofstream(folder.file("tour")) << "# a tour\n\npause\nset 'title=two words'\nwait 0.01\nstep none\nplay\n";
  const Outcome outcome = run(server, {"script", folder.file("tour")});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, HasSubstr("tour:6: "));
  bool played = false;
  std::string title;
  for (const v1::ClientMessage& message : server.received()) {
    played = played || (message.has_control() && message.control().action() == v1::Control::PLAY);
    if (message.has_update_scene()) title = message.update_scene().scene().title();
  }
  EXPECT_EQ(title, "two words");
  EXPECT_FALSE(played);
}

TEST(Script, EndsWithTheExitCodeOfItsLine) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("refused")) << "set look.smoothing.time=99\n";
  EXPECT_EQ(run(FakeServer(refuse), {"script", folder.file("refused")}).exitCode, 1);
  std::ofstream(folder.file("itself")) << "script itself\n";
  EXPECT_EQ(run(FakeServer(oblige), {"script", folder.file("itself")}).exitCode, 2);
  std::ofstream(folder.file("sleepy")) << "wait long\n";
  EXPECT_EQ(run(FakeServer(oblige), {"script", folder.file("sleepy")}).exitCode, 2);
}

}  // namespace
}  // namespace sluice::client
