// Verbs that read and write files, against a fake server: load and snapshot.

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_client.h"
#include "temporary_folder.h"
#include "test_pictures.h"

namespace sluice::client {
namespace {

using ::testing::HasSubstr;

std::string contents(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
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

}  // namespace
}  // namespace sluice::client
