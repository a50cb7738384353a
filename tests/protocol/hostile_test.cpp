// Viewers that do not behave, and what they cost the others: nothing.
#include <gtest/gtest.h>

#include "live_server.h"
#include "viewer/raw_socket.h"

namespace sluice::stream::test {
namespace {

using sluice::test::RawSocket;
using sluice::test::TestViewer;

// A well-behaved viewer with frames coming.
TestViewer watching(const LiveServer& server) {
  TestViewer viewer = server.connect();
  viewer.hello();
  viewer.setView(320, 200);
  viewer.nextFrame();
  return viewer;
}

void expectFrames(TestViewer& viewer, int count) {
  for (int i = 0; i < count; ++i) viewer.nextFrame();
}

v1::ClientMessage ping() {
  v1::ClientMessage message;
  message.mutable_ping()->set_client_time(1);
  return message;
}

TEST(HostileViewer, MalformedMessageClosesThatViewerAlone) {
  const LiveServer server;
  TestViewer other = watching(server);
  TestViewer hostile = watching(server);
  hostile.sendBinary("\xff\xff\xff\xff");
  EXPECT_EQ(hostile.waitForEnd().code, 1007);
  expectFrames(other, 50);
}

TEST(HostileViewer, MalformedFirstMessageClosesToo) {
  const LiveServer server;
  TestViewer hostile = server.connect();
  hostile.sendBinary("GET / HTTP/1.1\r\n\r\n");
  EXPECT_EQ(hostile.waitForEnd().code, 1007);
}

TEST(HostileViewer, TextMessageClosesWith1003) {
  const LiveServer server;
  TestViewer hostile = watching(server);
  hostile.sendText("{\"hello\": {}}");
  EXPECT_EQ(hostile.waitForEnd().code, 1003);
}

TEST(HostileViewer, OversizeMessageClosesWith1009ThatViewerAlone) {
  const LiveServer server({.maxMessageBytes = 1000});
  TestViewer other = watching(server);
  TestViewer hostile = server.connect();
  hostile.hello();
  hostile.sendBinary(std::string(1001, 'x'));
  EXPECT_EQ(hostile.waitForEnd().code, 1009);
  expectFrames(other, 50);
}

TEST(HostileViewer, MessageOfTheLargestSizeIsTaken) {
  const LiveServer server({.maxMessageBytes = 1000});
  TestViewer viewer = server.connect();
  viewer.hello();
  v1::ClientMessage message;
  message.set_sequence(100);
  message.mutable_load_scene()->set_name(std::string(1000 - 8, 'n'));
  ASSERT_EQ(message.ByteSizeLong(), 1000U);
  EXPECT_EQ(viewer.receiveReply(viewer.send(message)).error().code(), v1::Error::INVALID);
}

TEST(HostileViewer, WindowIsKeptWhenFramesAreNotAcknowledged) {
  LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  viewer.setView(320, 200);
  EXPECT_EQ(viewer.nextFrame(/*acknowledged=*/false).frame_id(), 1U);
  EXPECT_EQ(viewer.nextFrame(/*acknowledged=*/false).frame_id(), 2U);
  EXPECT_FALSE(viewer.tryReceive(std::chrono::milliseconds(100)));
  viewer.acknowledge(2);
  EXPECT_EQ(viewer.nextFrame().frame_id(), 3U);
  expectFrames(viewer, 50);
  EXPECT_EQ(server.backend.mostUnderWay(), 2U);
}

TEST(HostileViewer, FramesBeyondTheWindowAreDroppedByTheServerItself) {
  LiveServer server;
  TestViewer viewer = server.connect();
  const core::ViewerId id = viewer.hello().viewer_id();
  core::EncodedFrame frame;
  frame.size = {8, 8};
  frame.bytes.assign(100, 1);
  std::vector<SendResult> results;
  core::Delivery delivery;
  delivery.viewer = id;
  for (delivery.frameId = 1; delivery.frameId <= 5; ++delivery.frameId) {
    results.push_back(server->sendFrame(frame, delivery));
  }
  for (std::size_t i = 0; i < results.size(); ++i) EXPECT_EQ(results[i] == SendResult::Dropped, i >= 2) << i;
  core::Delivery nobody;
  nobody.viewer = id + 1;
  EXPECT_EQ(server->sendFrame(frame, nobody), SendResult::Gone);
  EXPECT_EQ(viewer.nextFrame(false).frame_id(), 1U);
  EXPECT_EQ(viewer.nextFrame(false).frame_id(), 2U);
  EXPECT_FALSE(viewer.tryReceive(std::chrono::milliseconds(50)));
}

TEST(HostileViewer, AcknowledgingFramesThatNeverWereIsRefused) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  v1::ClientMessage message;
  message.mutable_frame_ack()->set_frame_id(1000);
  EXPECT_EQ(viewer.receiveReply(viewer.send(message)).error().field_path(), "frame_ack.frame_id");
}

// Frames of 4 MB do not fit into the socket's buffers, so the server is left with a write that does not end.
constexpr std::size_t kMoreThanASocketTakes = 4'000'000;

// Not reached, however slow the machine: these tests are about what happens before it.
constexpr std::chrono::minutes kNoTimeout{10};

TEST(HostileViewer, ViewerThatStopsReadingDisturbsNobody) {
  LiveServer server({.writeTimeout = kNoTimeout}, kMoreThanASocketTakes);
  TestViewer stalled = server.connect({.receiveBufferBytes = 4096});
  stalled.hello();
  stalled.setView(320, 200);
  TestViewer other = watching(server);
  expectFrames(other, 20);
  EXPECT_EQ(server.backend.counts().left, 0);
  // What was meant for the stalled viewer was never more than its window.
  EXPECT_EQ(server.backend.mostUnderWay(), 2U);
}

TEST(HostileViewer, ViewerThatTakesNoBytesIsDropped) {
  LiveServer server({.writeTimeout = std::chrono::milliseconds(200)}, kMoreThanASocketTakes);
  TestViewer stalled = server.connect({.receiveBufferBytes = 4096});
  const core::ViewerId id = stalled.hello().viewer_id();
  stalled.setView(320, 200);
  EXPECT_TRUE(server.backend.waitForLeft(1));
  EXPECT_EQ(server->send(id, v1::ServerMessage()), SendResult::Gone);
  // A place is free again for one that reads.
  TestViewer other = server.connect();
  EXPECT_GT(other.hello().viewer_id(), id);
}

TEST(HostileViewer, RepliesThatNobodyReadsAreBounded) {
  LiveServer server({.writeTimeout = kNoTimeout});
  TestViewer other = watching(server);
  TestViewer stalled = server.connect({.receiveBufferBytes = 4096});
  const core::ViewerId id = stalled.hello().viewer_id();

  v1::ServerMessage message;
  message.mutable_error()->set_message(std::string(1'000'000, 'x'));
  SendResult result = SendResult::Sent;
  int sent = 0;
  // 64 MB of queue, and what the socket takes.
  for (; sent < 200 && result != SendResult::Overflow; ++sent) result = server->send(id, message);
  EXPECT_EQ(result, SendResult::Overflow);
  EXPECT_LT(sent, 100);
  EXPECT_TRUE(server.backend.waitForLeft(1));
  expectFrames(other, 20);
}

TEST(HostileViewer, StatisticsThatNobodyReadsTakeTheSpaceOfOne) {
  LiveServer server({.writeTimeout = kNoTimeout});
  TestViewer stalled = server.connect({.receiveBufferBytes = 4096});
  const core::ViewerId id = stalled.hello().viewer_id();
  v1::ServerMessage stats;
  stats.mutable_stats()->set_halted(std::string(1'000'000, 'x'));
  int replaced = 0;
  for (int i = 0; i < 200; ++i) {
    stats.mutable_stats()->set_steps(static_cast<std::uint64_t>(i));
    replaced += server->send(id, stats) == SendResult::Replaced ? 1 : 0;
  }
  EXPECT_GT(replaced, 100);
  // Once it reads again, it finds the newest.
  while (stalled.receive(v1::ServerMessage::kStats).stats().steps() != 199) {
  }
}

TEST(HostileViewer, FloodOfPingsIsAnsweredInOrder) {
  const LiveServer server;
  TestViewer viewer = server.connect();
  viewer.hello();
  std::uint64_t first = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t sequence = viewer.send(ping());
    if (first == 0) first = sequence;
  }
  for (std::uint64_t i = 0; i < 100; ++i) EXPECT_EQ(viewer.receive().in_reply_to(), first + i);
}

// The client ends without a word after the n-th thing that it does; the server must survive each, forget the viewer,
// and serve the next.
TEST(VanishingViewer, AtAnyStageLeavesNothingBehind) {
  LiveServer server({}, 2'000'000);
  using Step = void (*)(TestViewer&);
  const std::vector<Step> steps{
      [](TestViewer& viewer) { viewer.hello(); },
      [](TestViewer& viewer) { viewer.setView(320, 200); },
      [](TestViewer& viewer) { viewer.nextFrame(false); },
      [](TestViewer& viewer) { viewer.acknowledge(1); },
      [](TestViewer& viewer) { viewer.send(ping()); },
      [](TestViewer& viewer) { viewer.nextFrame(); },
      [](TestViewer& viewer) { viewer.sendBinary("\xff\xff"); },
  };
  int joined = 0;
  for (std::size_t stages = 0; stages <= steps.size(); ++stages) {
    TestViewer viewer = server.connect();
    for (std::size_t i = 0; i < stages; ++i) steps[i](viewer);
    viewer.vanish();
    joined += stages > 0 ? 1 : 0;
  }
  EXPECT_TRUE(server.backend.waitForLeft(joined));
  TestViewer viewer = watching(server);
  expectFrames(viewer, 5);
  EXPECT_EQ(server.backend.counts().joined, joined + 1);
}

// Cuts the connection after each byte of a handshake and of the first message behind it.
TEST(VanishingViewer, AfterAnyByteOfTheHandshakeLeavesNothingBehind) {
  LiveServer server;
  const std::string handshake =
      "GET /stream HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Protocol: sluice.v1\r\n\r\n";
  for (std::size_t length = 1; length <= handshake.size(); length += 7) {
    RawSocket socket(server.port());
    EXPECT_TRUE(socket.write(handshake.substr(0, length)));
    if (length % 2 == 0) socket.finishWriting();
    socket.vanish();
  }
  {
    RawSocket socket(server.port());
    socket.write(handshake);
    EXPECT_NE(socket.readUntil("\r\n\r\n").find("101 Switching Protocols"), std::string::npos);
    socket.write("\x82");  // The first half of a frame's head.
    socket.vanish();
  }
  TestViewer viewer = watching(server);
  expectFrames(viewer, 5);
}

TEST(HostileViewer, UnmaskedFrameClosesWith1002) {
  const LiveServer server;
  RawSocket socket(server.port());
  socket.write(
      "GET /stream HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Protocol: sluice.v1\r\n\r\n");
  socket.readUntil("\r\n\r\n");
  socket.write(std::string("\x82\x01\x00", 3));  // RFC 6455 section 5.1: a client must mask.
  socket.finishWriting();
  const std::string answer = socket.readAll();
  ASSERT_GE(answer.size(), 4U);
  EXPECT_EQ(answer[0], '\x88');                // A close frame.
  EXPECT_EQ(answer.substr(2, 2), "\x03\xea");  // 1002.
}

}  // namespace
}  // namespace sluice::stream::test
