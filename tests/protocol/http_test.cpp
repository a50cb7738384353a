// The HTTP side: page, health, refusals of the handshake, and starting and stopping the server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "live_server.h"
#include "sluice/core/input_error.h"
#include "viewer/raw_socket.h"

namespace sluice::stream::test {
namespace {

using sluice::test::HandshakeRefused;
using sluice::test::httpExchange;
using sluice::test::httpGet;
using sluice::test::RawSocket;
using sluice::test::TestViewer;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
namespace fs = std::filesystem;

struct HttpTest : testing::Test {
  HttpTest() : base(folder()), server({.webRoot = base / "web"}) {}
  ~HttpTest() override { fs::remove_all(base); }

  static fs::path folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const fs::path base = fs::path(testing::TempDir()) / (std::string("sluice_http_") + test->name());
    fs::remove_all(base);
    fs::create_directories(base / "web/assets");
    std::ofstream(base / "web/index.html") << "<html>page</html>";
    std::ofstream(base / "web/assets/index-abcd1234.js") << "run();";
    std::ofstream(base / "secret.txt") << "secret";
    return base;
  }

  std::string get(const std::string& target, const std::string& headers = {}) const {
    return httpGet(server.port(), target, headers);
  }

  // The handshake's refusal; the status is 0 where it was let in.
  int refusal(const sluice::test::ConnectOptions& options) const {
    try {
      server.connect(options);
      return 0;
    } catch (const HandshakeRefused& refused) {
      return refused.status;
    }
  }

  fs::path base;
  LiveServer server;
};

TEST_F(HttpTest, ServesThePage) {
  const std::string page = get("/");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(page, HasSubstr("Content-Type: text/html; charset=utf-8\r\n"));
  EXPECT_THAT(page, HasSubstr("Cache-Control: no-cache\r\n"));
  EXPECT_THAT(page, EndsWith("\r\n\r\n<html>page</html>"));
  const std::string script = get("/assets/index-abcd1234.js");
  EXPECT_THAT(script, HasSubstr("Content-Type: text/javascript"));
  EXPECT_THAT(script, HasSubstr("immutable"));
}

TEST_F(HttpTest, UnchangedPageIsNotSentAgain) {
  const std::string page = get("/");
  const std::size_t tag = page.find("ETag: ") + 6;
  const std::string etag = page.substr(tag, page.find("\r\n", tag) - tag);
  const std::string again = get("/", "If-None-Match: " + etag + "\r\n");
  EXPECT_THAT(again, StartsWith("HTTP/1.1 304 Not Modified\r\n"));
  EXPECT_THAT(again, EndsWith("\r\n\r\n"));
  EXPECT_THAT(get("/", "If-None-Match: \"other\"\r\n"), StartsWith("HTTP/1.1 200 OK\r\n"));
}

TEST_F(HttpTest, HeadTellsTheLengthWithoutTheBody) {
  const std::string head =
      httpExchange(server.port(), "HEAD / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(head, HasSubstr("Content-Length: 17\r\n"));
  EXPECT_THAT(head, EndsWith("\r\n\r\n"));
}

TEST_F(HttpTest, ConnectionIsKeptForTheNextRequest) {
  RawSocket socket(server.port());
  for (int i = 0; i < 3; ++i) {
    socket.write("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_THAT(socket.readUntil("</html>"), StartsWith("HTTP/1.1 200 OK\r\n"));
  }
}

TEST_F(HttpTest, WhatIsNotThereIsNotFound) {
  EXPECT_THAT(get("/missing"), StartsWith("HTTP/1.1 404 Not Found\r\n"));
  for (const std::string target :
       {"/../secret.txt", "/%2e%2e/secret.txt", "/assets/..%2f..%2fsecret.txt", "//secret.txt"}) {
    const std::string answer = get(target);
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 404 Not Found\r\n")) << target;
    EXPECT_THAT(answer, Not(HasSubstr("secret\n"))) << target;
  }
  EXPECT_THAT(get("/%zz"), StartsWith("HTTP/1.1 400 Bad Request\r\n"));
}

TEST_F(HttpTest, OtherMethodsAreNotAllowed) {
  const std::string answer =
      httpExchange(server.port(), "DELETE / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 405 Method Not Allowed\r\n"));
  EXPECT_THAT(answer, HasSubstr("Allow: GET, HEAD\r\n"));
}

TEST_F(HttpTest, GarbageAndExcessAreRefused) {
  EXPECT_THAT(httpExchange(server.port(), "\x16\x03\x01 garbage\r\n\r\n"), StartsWith("HTTP/1.1 400"));
  const std::string longHead = "GET / HTTP/1.1\r\nX: " + std::string(40'000, 'x');
  RawSocket socket(server.port());
  socket.write(longHead);
  EXPECT_THAT(socket.readUntil("\r\n\r\n"), StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(httpExchange(server.port(), "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 9999999\r\n\r\n"),
              StartsWith("HTTP/1.1 413"));
}

TEST_F(HttpTest, HealthTellsTheNumberOfViewers) {
  const auto body = [&] { return get("/healthz"); };
  EXPECT_THAT(body(), StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(body(), HasSubstr("Content-Type: application/json\r\n"));
  EXPECT_THAT(body(), HasSubstr(R"("status": "ok", "viewers": 0, "version": ")"));
  const TestViewer viewer = server.connect();
  EXPECT_THAT(body(), HasSubstr(R"("viewers": 1)"));
}

TEST_F(HttpTest, StreamWithoutAnUpgradeSaysWhatItNeeds) {
  EXPECT_THAT(get("/stream"), StartsWith("HTTP/1.1 426 Upgrade Required\r\n"));
}

TEST_F(HttpTest, HandshakeNeedsTheSubprotocol) {
  EXPECT_EQ(refusal({}), 0);
  EXPECT_EQ(refusal({.subprotocol = "chat, sluice.v1"}), 0);
  EXPECT_EQ(refusal({.subprotocol = ""}), 400);
  EXPECT_EQ(refusal({.subprotocol = "sluice.v2"}), 400);
  EXPECT_EQ(refusal({.target = "/elsewhere"}), 404);
}

TEST_F(HttpTest, PagesOfOtherOriginsMayNotConnect) {
  const std::string own = "127.0.0.1:" + std::to_string(server.port());
  EXPECT_EQ(refusal({.origin = "http://" + own}), 0);
  EXPECT_EQ(refusal({.origin = "https://" + own}), 0);
  EXPECT_EQ(refusal({.origin = "http://evil.example"}), 403);
  EXPECT_EQ(refusal({.origin = "http://127.0.0.1:1"}), 403);
  EXPECT_EQ(refusal({.origin = "null"}), 403);
}

TEST(HttpServer, AllowedOriginsMayConnect) {
  const LiveServer server({.allowedOrigins = {"https://example.org"}});
  EXPECT_NO_THROW(server.connect({.origin = "https://example.org"}));
  EXPECT_THROW(server.connect({.origin = "https://example.org.evil.example"}), HandshakeRefused);
}

TEST(HttpServer, ViewersBeyondThePlacesGet503UntilOneLeaves) {
  LiveServer server({.maxViewers = 2});
  TestViewer first = server.connect();
  TestViewer second = server.connect();
  first.hello();
  try {
    server.connect();
    FAIL() << "a third viewer was let in";
  } catch (const HandshakeRefused& refused) {
    EXPECT_EQ(refused.status, 503);
  }
  first.close();
  ASSERT_TRUE(server.backend.waitForLeft(1));
  EXPECT_NO_THROW(server.connect());
}

TEST(HttpServer, BusyPortIsAnEnvironmentErrorInOneLine) {
  const LiveServer server;
  FakeBackend backend;
  ServerOptions options;
  options.port = server.port();
  try {
    const Server second(options, backend);
    FAIL() << "the port was given twice";
  } catch (const core::EnvironmentError& error) {
    EXPECT_EQ(std::string(error.what()),
              "cannot listen on 127.0.0.1:" + std::to_string(server.port()) + ": address already in use");
  }
}

TEST(HttpServer, AddressThatIsNotOursIsAnEnvironmentError) {
  FakeBackend backend;
  ServerOptions options;
  options.address = "192.0.2.1";  // RFC 5737: belongs to nobody.
  options.port = 0;
  EXPECT_THROW(Server(options, backend), core::EnvironmentError);
}

TEST(HttpServer, StopsWhateverItsConnectionsDo) {
  LiveServer server({}, 4'000'000);
  TestViewer stalled = server.connect({.receiveBufferBytes = 4096});
  stalled.hello();
  stalled.setView(320, 200);
  const TestViewer silent = server.connect();
  const RawSocket idle(server.port());
  RawSocket halfway(server.port());
  halfway.write("GET / HT");
  // Returns, or the test's timeout says that it did not.
  server.stop("the server restarts");
  EXPECT_EQ(server.backend.counts().left, 1);
  EXPECT_EQ(server->send(1, v1::ServerMessage()), SendResult::Gone);
}

TEST(HttpServer, StopBeforeRunEndsItAtOnce) {
  FakeBackend backend;
  ServerOptions options;
  options.port = 0;
  Server server(options, backend);
  server.stop("never mind");
  server.stop("twice");
  server.run();
}

TEST(HttpServer, PortIsFreeAgainAfterTheServer) {
  FakeBackend backend;
  ServerOptions options;
  options.port = 0;
  {
    const Server first(options, backend);
    options.port = first.port();
  }
  EXPECT_NO_THROW(Server(options, backend));
}

}  // namespace
}  // namespace sluice::stream::test
