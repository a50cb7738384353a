#include "outbox.h"

#include <gtest/gtest.h>

#include <thread>

namespace sluice::stream::test {
namespace {

WireMessage wire(const std::string& text) { return std::make_shared<const std::string>(text); }

// The text of the next message; empty when there is none.
std::string taken(Outbox& outbox) {
  const auto item = outbox.next();
  if (!item) return {};
  if (const auto* close = std::get_if<CloseReason>(&*item)) return "close: " + close->text;
  return *std::get<WireMessage>(*item);
}

TEST(Outbox, FirstMessageWakesTheWriterThatWaits) {
  Outbox outbox({});
  EXPECT_FALSE(outbox.next());
  EXPECT_EQ(outbox.pushReply(wire("a")), SendResult::Sent);
  EXPECT_EQ(outbox.pushReply(wire("b")), SendResult::Queued);
  EXPECT_EQ(taken(outbox), "a");
  // The writer is at work and will ask again by itself.
  EXPECT_EQ(outbox.pushReply(wire("c")), SendResult::Queued);
  EXPECT_EQ(taken(outbox), "b");
  EXPECT_EQ(taken(outbox), "c");
  EXPECT_FALSE(outbox.next());
}

TEST(Outbox, MessagesKeepTheirOrderAndGoBeforeFrames) {
  Outbox outbox({});
  outbox.pushFrame(1, wire("frame"));
  outbox.pushLatest(Outbox::Latest::Plan, wire("plan"));
  outbox.pushLatest(Outbox::Latest::Stats, wire("stats"));
  outbox.pushReply(wire("reply"));
  outbox.pushLatest(Outbox::Latest::Stats, wire("newer stats"));
  EXPECT_EQ(taken(outbox), "plan");
  EXPECT_EQ(taken(outbox), "newer stats") << "in the place of the older ones: the reply tells that they were said";
  EXPECT_EQ(taken(outbox), "reply");
  EXPECT_EQ(taken(outbox), "frame");
}

TEST(Outbox, OnlyTheNewestOfItsKindIsKept) {
  Outbox outbox({});
  EXPECT_EQ(outbox.pushLatest(Outbox::Latest::Stats, wire("old")), SendResult::Queued);
  EXPECT_EQ(outbox.pushLatest(Outbox::Latest::Stats, wire("new")), SendResult::Replaced);
  EXPECT_EQ(outbox.pushLatest(Outbox::Latest::Plan, wire("plan")), SendResult::Queued);
  EXPECT_EQ(taken(outbox), "new");
  EXPECT_EQ(taken(outbox), "plan");
}

TEST(Outbox, NeverHoldsMoreFramesThanTheWindow) {
  Outbox outbox({.frameWindow = 2});
  EXPECT_EQ(outbox.pushFrame(1, wire("1")), SendResult::Queued);
  EXPECT_EQ(outbox.pushFrame(2, wire("2")), SendResult::Queued);
  EXPECT_EQ(outbox.pushFrame(3, wire("3")), SendResult::Dropped);
  EXPECT_EQ(taken(outbox), "1");
  // Sending is not enough to make room; the viewer has to have drawn it.
  EXPECT_EQ(outbox.pushFrame(4, wire("4")), SendResult::Dropped);
  EXPECT_FALSE(outbox.acknowledge(2)) << "it was not sent yet";
  EXPECT_TRUE(outbox.acknowledge(1));
  EXPECT_FALSE(outbox.acknowledge(1));
  EXPECT_EQ(outbox.pushFrame(5, wire("5")), SendResult::Queued);
  EXPECT_EQ(taken(outbox), "2");
  EXPECT_EQ(taken(outbox), "5");
  EXPECT_TRUE(outbox.acknowledge(5)) << "which acknowledges 2 as well";
  EXPECT_FALSE(outbox.acknowledge(2));
}

TEST(Outbox, TooManyRepliesEndTheConnection) {
  Outbox outbox({.replies = 3});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(outbox.pushReply(wire("x")), SendResult::Queued);
  EXPECT_EQ(outbox.pushReply(wire("x")), SendResult::Overflow);
  EXPECT_TRUE(outbox.closed());
  EXPECT_EQ(outbox.pushReply(wire("x")), SendResult::Gone);
  EXPECT_EQ(outbox.pushFrame(1, wire("x")), SendResult::Gone);
  EXPECT_EQ(outbox.pushLatest(Outbox::Latest::Stats, wire("x")), SendResult::Gone);
  EXPECT_EQ(taken(outbox), "close: too many messages wait to be read");
  EXPECT_FALSE(outbox.next());
}

TEST(Outbox, TooManyBytesOfRepliesEndTheConnection) {
  Outbox outbox({.replyBytes = 10});
  EXPECT_EQ(outbox.pushReply(wire("123456")), SendResult::Queued);
  EXPECT_EQ(taken(outbox), "123456");
  EXPECT_EQ(outbox.pushReply(wire("123456")), SendResult::Queued) << "what was taken no longer counts";
  EXPECT_EQ(outbox.pushReply(wire("12345")), SendResult::Overflow);
}

TEST(Outbox, ClosingDropsWhatWaitsAndKeepsTheFirstReason) {
  Outbox outbox({});
  outbox.pushReply(wire("reply"));
  outbox.pushFrame(1, wire("frame"));
  outbox.close({CloseCode::GoingAway, "first"});
  outbox.close({CloseCode::PolicyViolation, "second"});
  const auto item = outbox.next();
  ASSERT_TRUE(item);
  EXPECT_EQ(std::get<CloseReason>(*item), (CloseReason{CloseCode::GoingAway, "first"}));
  EXPECT_FALSE(outbox.next());
}

TEST(Outbox, HeldMessagesFollowTheWelcome) {
  Outbox outbox({});
  EXPECT_FALSE(outbox.next());
  outbox.hold();
  EXPECT_EQ(outbox.pushReply(wire("change")), SendResult::Queued);
  EXPECT_FALSE(outbox.next());
  outbox.release(wire("welcome"));
  EXPECT_EQ(taken(outbox), "welcome");
  EXPECT_EQ(taken(outbox), "change");
}

TEST(Outbox, ManyThreadsFillItAndNothingIsLost) {
  constexpr int kPerThread = 500;
  Outbox outbox({.frameWindow = 2, .replies = 4 * kPerThread});
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&outbox] {
      for (int i = 0; i < kPerThread; ++i) {
        outbox.pushReply(wire("r"));
        outbox.pushLatest(Outbox::Latest::Stats, wire("s"));
      }
    });
  }
  int replies = 0;
  while (replies < 3 * kPerThread) replies += taken(outbox) == "r" ? 1 : 0;
  for (std::thread& thread : threads) thread.join();
  while (outbox.next()) {
  }
  EXPECT_FALSE(outbox.closed());
}

}  // namespace
}  // namespace sluice::stream::test
