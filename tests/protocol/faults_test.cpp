// Every read, write and wait of a connection fails once, each in a run of its own: whatever fails, that viewer's
// connection ends and nothing else does.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <system_error>

#include "live_server.h"
#include "viewer/raw_socket.h"

namespace sluice::stream::test {
namespace {

using sluice::test::ConnectionEnded;
using sluice::test::TestViewer;

/// Lets the n-th operation of a connection fail.
class NthOperation {
 public:
  void arm(int n) { left_ = n; }
  /// Whether it came to the n-th.
  bool struck() const { return left_ <= 0; }
  bool operator()() { return --left_ == 0; }

 private:
  std::atomic<int> left_ = std::numeric_limits<int>::max();
};

/// All that a viewer does: a page, a handshake, frames, an update, a snapshot, a malformed message at the end.
void play(std::uint16_t port) {
  sluice::test::httpGet(port, "/healthz");
  TestViewer viewer("127.0.0.1", port);
  viewer.hello();
  viewer.setView(320, 200);
  for (int k = 0; k < 3; ++k) viewer.nextFrame();
  v1::ClientMessage update;
  update.mutable_update_scene()->mutable_scene()->mutable_look()->mutable_smoothing()->set_time(2);
  update.mutable_update_scene()->mutable_mask()->add_paths("look.smoothing.time");
  viewer.receiveReply(viewer.send(update));
  v1::ClientMessage snapshot;
  snapshot.mutable_snapshot()->set_width(64);
  snapshot.mutable_snapshot()->set_height(64);
  viewer.receiveReply(viewer.send(snapshot));
  viewer.sendBinary("\xff\xff");
  viewer.waitForEnd();
}

void playAsFarAsItGoes(std::uint16_t port) {
  try {
    play(port);
  } catch (const std::runtime_error&) {
    // The connection has ended, was refused, or was cut within a message.
  }
}

TEST(Faults, WhateverFailsEndsOneConnectionAndNothingElse) {
  NthOperation nth;
  ServerOptions options;
  options.failsNow = [&nth] { return nth(); };
  options.writeTimeout = std::chrono::milliseconds(400);
  LiveServer server(options);

  int runs = 0;
  for (bool struck = true; struck; ++runs) {
    ASSERT_LT(runs, 500) << "a conversation takes fewer operations";
    nth.arm(runs + 1);
    playAsFarAsItGoes(server.port());
    struck = nth.struck();
    nth.arm(std::numeric_limits<int>::max());
    ASSERT_TRUE(server.backend.waitForLeft(server.backend.counts().joined)) << "after operation " << runs + 1;
    // The next viewer finds all in order.
    ASSERT_NO_THROW(play(server.port())) << "after operation " << runs + 1;
  }
  EXPECT_GT(runs, 20) << "that few operations cannot be all";
  EXPECT_TRUE(server.backend.waitForLeft(server.backend.counts().joined));
}

}  // namespace
}  // namespace sluice::stream::test
