#include "sluice/client/connection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_server.h"
#include "sluice/client/failure.h"
#include "sluice/client/requests.h"

namespace sluice::client {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

constexpr std::chrono::seconds kPatience{20};

/// What connecting comes to.
std::string complaint(const FakeServer& server, std::chrono::milliseconds timeout = kPatience) {
  try {
    const Connection connection(server.url(), timeout);
  } catch (const ConnectionError& error) {
    return error.what();
  }
  return "(connected)";
}

v1::ClientMessage play() {
  v1::ClientMessage message;
  message.mutable_control()->set_action(v1::Control::PLAY);
  return message;
}

TEST(Connection, GreetsAndIsWelcomed) {
  const FakeServer server(oblige);
  const Connection connection(server.url(), kPatience);
  EXPECT_EQ(connection.welcome().renderer(), "a renderer");
  ASSERT_EQ(server.received().size(), 1U);
  EXPECT_TRUE(server.received()[0].has_hello());
}

TEST(Connection, NumbersItsMessagesUpwards) {
  const FakeServer server(oblige);
  Connection connection(server.url(), kPatience);
  request(connection, play());
  request(connection, play());
  std::vector<std::uint64_t> numbers;
  for (const v1::ClientMessage& message : server.received()) numbers.push_back(message.sequence());
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3));
}

TEST(Connection, SaysWhyItCannotConnect) {
  EXPECT_THAT(complaint(FakeServer(503)), AllOf(HasSubstr("cannot connect to ws://127.0.0.1:"), HasSubstr("503")));
  ServerUrl nobody;
  {
    const FakeServer gone(oblige);
    nobody = gone.url();
  }
  EXPECT_THROW(Connection(nobody, kPatience), ConnectionError);
}

TEST(Connection, DoesNotWaitForSilence) {
  EXPECT_THAT(complaint(FakeServer([](const auto&) { return Reaction(); }), 100ms), HasSubstr("does not greet back"));
}

TEST(Connection, PassesOnTheServersRefusal) {
  const FakeServer full([](const v1::ClientMessage& message) {
    v1::ServerMessage reply = replyTo(message);
    reply.mutable_error()->set_message("sixteen viewers are enough");
    return Reaction{.messages = {reply}};
  });
  EXPECT_THAT(complaint(full), HasSubstr("sixteen viewers are enough"));
}

TEST(Connection, RefusesAnotherProtocol) {
  const FakeServer newer([](const v1::ClientMessage& message) {
    Reaction reaction = oblige(message);
    reaction.messages[0].mutable_welcome()->set_protocol_version(2);
    return reaction;
  });
  EXPECT_THAT(complaint(newer), HasSubstr("speaks protocol 2"));
}

TEST(Connection, TellsHowItEnded) {
  const FakeServer closing([](const v1::ClientMessage& message) {
    Reaction reaction = oblige(message);
    reaction.close = !message.has_hello();
    return reaction;
  });
  Connection connection(closing.url(), kPatience);
  connection.send(play());
  // What the server said before it closed is still given out.
  EXPECT_TRUE(connection.receive(Connection::Clock::now() + kPatience)->has_done());
  try {
    connection.receive(Connection::Clock::now() + kPatience);
    FAIL() << "the connection has not ended";
  } catch (const ConnectionError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("has ended"), HasSubstr("enough")));
  }
}

TEST(Connection, EndsOnBytesThatAreNoMessage) {
  const FakeServer garbling([](const v1::ClientMessage& message) {
    if (message.has_hello()) return oblige(message);
    return Reaction{.bytes = "\xFF\xFF\xFF garbage"};
  });
  Connection connection(garbling.url(), kPatience);
  connection.send(play());
  EXPECT_THROW(connection.receive(Connection::Clock::now() + kPatience), ConnectionError);
}

TEST(Connection, GivesNothingWhenTheTimeIsOver) {
  const FakeServer server(oblige);
  Connection connection(server.url(), kPatience);
  EXPECT_FALSE(connection.receive(Connection::Clock::now() + 20ms).has_value());
  // The read that was under way is not lost by this.
  connection.send(play());
  EXPECT_TRUE(connection.receive(Connection::Clock::now() + kPatience)->has_done());
}

TEST(Connection, RefusesToSendMoreThanTheServerTakes) {
  const FakeServer server(oblige);
  Connection connection(server.url(), kPatience);
  v1::ClientMessage large;
  large.mutable_load_scene()->set_text(std::string(2U << 20U, ' '));
  EXPECT_THROW(connection.send(large), RequestError);
  EXPECT_TRUE(request(connection, play()).has_done());
}

TEST(Request, PassesOverWhatIsNotItsAnswer) {
  const FakeServer server([](const v1::ClientMessage& message) {
    Reaction reaction = oblige(message);
    if (message.has_hello()) return reaction;
    v1::ServerMessage other;
    other.set_in_reply_to(message.sequence() - 1);
    other.mutable_error()->set_message("about something else");
    reaction.messages.insert(reaction.messages.begin(), other);
    return reaction;
  });
  Connection connection(server.url(), kPatience);
  int others = 0;
  EXPECT_TRUE(request(connection, play(), [&](const auto&) { ++others; }).has_done());
  EXPECT_EQ(others, 1);
}

TEST(Request, DoesNotWaitForSilence) {
  const FakeServer silent(
      [](const v1::ClientMessage& message) { return message.has_hello() ? oblige(message) : Reaction(); });
  Connection connection(silent.url(), 200ms);
  EXPECT_THROW(request(connection, play()), RequestError);
}

TEST(CurrentStats, AreWhatTheServerToldBeforeThePong) {
  const FakeServer server(oblige);
  Connection connection(server.url(), kPatience);
  EXPECT_FALSE(connection.latestStats().has_value());
  EXPECT_EQ(currentStats(connection).particles(), 1234U);
}

TEST(CurrentStats, AreKnownEvenIfToldBeforeTheAnswerToAChange) {
  // Tells its state with the change alone, and not again.
  const FakeServer server([](const v1::ClientMessage& message) {
    Reaction reaction = oblige(message);
    v1::ServerMessage stats;
    stats.mutable_stats()->set_steps(7);
    if (message.has_control()) reaction.messages.insert(reaction.messages.begin(), stats);
    if (message.has_ping()) reaction.messages.erase(reaction.messages.begin());
    return reaction;
  });
  Connection connection(server.url(), kPatience);
  request(connection, play());
  EXPECT_EQ(currentStats(connection).steps(), 7U);
}

}  // namespace
}  // namespace sluice::client
