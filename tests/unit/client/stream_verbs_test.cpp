// Verbs that look on, against a fake server: watch and bench.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_client.h"
#include "test_pictures.h"

namespace sluice::client {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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

}  // namespace
}  // namespace sluice::client
