// What all verbs share: usage, help, the server and its tokens, and scripts of them.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_client.h"
#include "temporary_folder.h"

namespace sluice::client {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

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
