// Who may come in, as what, and how much they may ask.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "live_server.h"
#include "viewer/raw_socket.h"

namespace sluice::stream::test {
namespace {

using sluice::test::ConnectOptions;
using sluice::test::HandshakeRefused;
using sluice::test::httpGet;
using sluice::test::TestViewer;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kDriver = "driver-token-0123456789";
constexpr const char* kSpectator = "spectator-token-0123456789";

ServerOptions guarded() {
  ServerOptions options;
  options.access = {.driverToken = kDriver, .spectatorToken = kSpectator};
  return options;
}

v1::ClientMessage play() {
  v1::ClientMessage message;
  message.mutable_control()->set_action(v1::Control::PLAY);
  return message;
}

int refusedWith(const LiveServer& server, const ConnectOptions& options) {
  try {
    server.connect(options);
    return 0;
  } catch (const HandshakeRefused& refused) {
    return refused.status;
  }
}

TEST(Access, WithoutTokensEverybodyDrives) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  EXPECT_EQ(viewer.hello().role(), v1::DRIVER);
}

TEST(Access, WhoeverWishesLooksOn) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  EXPECT_EQ(viewer.helloAs(v1::SPECTATOR).role(), v1::SPECTATOR);
  EXPECT_EQ(viewer.receiveReply(viewer.send(play())).error().code(), v1::Error::REFUSED);
}

TEST(Access, TheTokenInTheHelloGivesTheRole) {
  const LiveServer server(guarded());
  TestViewer driver = server.connect();
  EXPECT_EQ(driver.helloAs(v1::ROLE_UNSPECIFIED, kDriver).role(), v1::DRIVER);
  EXPECT_TRUE(driver.receiveReply(driver.send(play())).has_done());
  TestViewer spectator = server.connect();
  EXPECT_EQ(spectator.helloAs(v1::ROLE_UNSPECIFIED, kSpectator).role(), v1::SPECTATOR);
  EXPECT_EQ(spectator.receiveReply(spectator.send(play())).error().code(), v1::Error::REFUSED);
}

TEST(Access, TheTokenInTheHandshakeWillDo) {
  const LiveServer server(guarded());
  TestViewer viewer = server.connect({.token = kDriver});
  EXPECT_EQ(viewer.hello().role(), v1::DRIVER);
}

TEST(Access, AWrongTokenIsRefusedAtOnce) {
  const LiveServer server(guarded());
  EXPECT_EQ(refusedWith(server, {.token = "driver-token-0123456780"}), 401);
}

TEST(Access, AWrongOrMissingTokenInTheHelloEndsTheConnection) {
  LiveServer server(guarded());
  for (const std::string token : {"", "wrong", "driver-token-012345678", "driver-token-01234567890"}) {
    TestViewer viewer = server.connect();
    v1::ClientMessage hello;
    hello.mutable_hello()->set_token(token);
    viewer.send(hello);
    const auto end = viewer.waitForEnd();
    EXPECT_EQ(end.code, 1008) << token;
    EXPECT_THAT(end.reason, HasSubstr("token"));
  }
  TestViewer greedy = server.connect();
  v1::ClientMessage hello;
  hello.mutable_hello()->set_token(kSpectator);
  hello.mutable_hello()->set_role(v1::DRIVER);
  greedy.send(hello);
  EXPECT_EQ(greedy.waitForEnd().code, 1008) << "the spectators' token drives nothing";
  EXPECT_EQ(server.backend.counts().joined, 0);
}

TEST(Access, TokensNeverReachTheLog) {
  std::string log;
  {
    ServerOptions options = guarded();
    options.log = [&](const LogEvent& event) {
      log.append(event.name);
      for (const auto& [key, value] : event.fields) log.append(" ").append(key).append("=").append(value);
    };
    LiveServer server(options);
    TestViewer viewer = server.connect({.token = kDriver});
    viewer.helloAs(v1::DRIVER, kDriver);
    refusedWith(server, {.token = "some-other-secret-token"});
    viewer.close();
    server.backend.waitForLeft(1);
    server.stop("done");
  }
  EXPECT_THAT(log, HasSubstr("viewer_connected"));
  EXPECT_THAT(log, HasSubstr("handshake_refused"));
  EXPECT_THAT(log, Not(HasSubstr(kDriver)));
  EXPECT_THAT(log, Not(HasSubstr("some-other-secret-token")));
}

TEST(Access, SilenceInsteadOfAHelloEndsTheConnection) {
  ServerOptions options;
  options.helloTimeout = std::chrono::milliseconds(200);
  const LiveServer server(options);
  TestViewer viewer = server.connect();
  EXPECT_EQ(viewer.waitForEnd().code, 1008);
}

TEST(Access, OneAddressGetsNoMoreThanItsPlaces) {
  ServerOptions options;
  options.maxViewersPerAddress = 2;
  LiveServer server(options);
  TestViewer first = server.connect();
  TestViewer second = server.connect();
  first.hello();
  EXPECT_EQ(refusedWith(server, {}), 503);
  first.close();
  ASSERT_TRUE(server.backend.waitForLeft(1));
  // The place is free once the connection is gone, a moment after the viewer has left.
  int status = 503;
  for (int k = 0; k < 200 && status == 503; ++k) {
    status = refusedWith(server, {});
    if (status == 503) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(status, 0);
}

TEST(Access, AFloodOfMessagesIsReadNoFasterThanAllowedAndDelaysNobody) {
  ServerOptions options;
  options.maxMessageRate = 100;
  LiveServer server(options);
  TestViewer other = server.connect();
  other.hello();
  other.setView(320, 200);
  TestViewer flood = server.connect();
  flood.hello();
  const auto begun = std::chrono::steady_clock::now();
  std::uint64_t last = 0;
  for (int k = 0; k < 300; ++k) {
    v1::ClientMessage ping;
    ping.mutable_ping();
    last = flood.send(ping);
  }
  for (int k = 0; k < 20; ++k) other.nextFrame();
  EXPECT_TRUE(flood.receiveReply(last).has_pong()) << "late, and not lost";
  // 300 messages of which 200 come at once leave 100 at 100 a second.
  EXPECT_GT(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(900));
}

TEST(Access, MetricsNeedTheToken) {
  const LiveServer server(guarded());
  EXPECT_THAT(httpGet(server.port(), "/metrics"), StartsWith("HTTP/1.1 401"));
  const std::string page =
      httpGet(server.port(), "/metrics", "Authorization: Bearer " + std::string(kSpectator) + "\r\n");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("# TYPE sluice_viewers gauge\nsluice_viewers 0\n"));
  EXPECT_THAT(page, HasSubstr("# TYPE sluice_controls_total counter\nsluice_controls_total 0\n"));
  EXPECT_THAT(httpGet(server.port(), "/healthz"), StartsWith("HTTP/1.1 200")) << "open to all";
}

}  // namespace
}  // namespace sluice::stream::test
