#include "sluice/core/mailbox.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace sluice::core {
namespace {

TEST(Mailbox, GivesTheNewestValueOnce) {
  Mailbox<int> mailbox;
  EXPECT_EQ(mailbox.take(), nullptr);
  EXPECT_FALSE(mailbox.put(std::make_shared<const int>(1)));
  EXPECT_TRUE(mailbox.put(std::make_shared<const int>(2))) << "the first was not taken";
  EXPECT_EQ(*mailbox.take(), 2);
  EXPECT_EQ(mailbox.take(), nullptr);
  EXPECT_FALSE(mailbox.put(std::make_shared<const int>(3)));
}

TEST(Mailbox, PeekLeavesTheValue) {
  Mailbox<int> mailbox;
  EXPECT_EQ(mailbox.peek(), nullptr);
  mailbox.put(std::make_shared<const int>(1));
  EXPECT_EQ(*mailbox.peek(), 1);
  EXPECT_EQ(*mailbox.take(), 1);
}

TEST(Mailbox, LetsReplacedValuesGo) {
  Mailbox<int> mailbox;
  auto value = std::make_shared<const int>(1);
  const std::weak_ptr<const int> watched = value;
  mailbox.put(std::move(value));
  mailbox.put(std::make_shared<const int>(2));
  EXPECT_TRUE(watched.expired());
}

TEST(Mailbox, NeverGivesAnOlderValueAfterANewerOne) {
  Mailbox<int> mailbox;
  constexpr int kLast = 20000;
  std::thread producer([&] {
    for (int i = 1; i <= kLast; ++i) mailbox.put(std::make_shared<const int>(i));
  });
  int newest = 0;
  while (newest < kLast) {
    const auto value = mailbox.take();
    if (!value) continue;
    ASSERT_GT(*value, newest);
    newest = *value;
  }
  producer.join();
}

}  // namespace
}  // namespace sluice::core
