#include "session_protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conversation.h"
#include "sluice/core/input_error.h"

namespace sluice::stream::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

v1::ClientMessage ping(double time = 1) {
  v1::ClientMessage message;
  message.mutable_ping()->set_client_time(time);
  return message;
}

v1::ClientMessage play() {
  v1::ClientMessage message;
  message.mutable_control()->set_action(v1::Control::PLAY);
  return message;
}

v1::ClientMessage acknowledgement(std::uint64_t frameId) {
  v1::ClientMessage message;
  message.mutable_frame_ack()->set_frame_id(frameId);
  return message;
}

WireMessage wire(const std::string& text) { return std::make_shared<const std::string>(text); }

TEST(SessionProtocol, HelloIsAnsweredByWelcomeBeforeTheViewerJoins) {
  Conversation talk;
  talk.backend.onCall = [&](const std::string& call) {
    // What the backend broadcasts while it makes the Welcome has to follow it.
    if (call != "welcome") return;
    talk.outbox.pushReply(wire(ping().SerializeAsString()));
    EXPECT_TRUE(talk.protocol.joined());
  };
  v1::ClientMessage message;
  message.mutable_hello()->set_client("somebody 1.0");
  const auto answers = talk.say(message);
  EXPECT_THAT(talk.backend.calls, ElementsAre("welcome", "join 5"));
  ASSERT_EQ(answers.size(), 2U);
  ASSERT_TRUE(answers[0].has_welcome());
  EXPECT_EQ(answers[0].in_reply_to(), 1U);
  EXPECT_EQ(answers[0].welcome().viewer_id(), 5U);
  EXPECT_EQ(answers[0].welcome().limits().max_width(), 1920U);
  EXPECT_EQ(talk.protocol.client(), "somebody 1.0");
}

TEST(SessionProtocol, NothingIsHeardBeforeHello) {
  Conversation talk;
  EXPECT_EQ(talk.refused(play()).code(), v1::Error::REFUSED);
  EXPECT_EQ(talk.refused(ping()).code(), v1::Error::REFUSED);
  EXPECT_THAT(talk.backend.calls, IsEmpty());
  EXPECT_FALSE(talk.protocol.joined());
  talk.hello();
  EXPECT_TRUE(talk.protocol.joined());
}

TEST(SessionProtocol, HelloIsSaidOnce) {
  Conversation talk;
  talk.hello();
  v1::ClientMessage again;
  again.mutable_hello();
  EXPECT_EQ(talk.refused(again).code(), v1::Error::REFUSED);
  EXPECT_THAT(talk.backend.calls, IsEmpty());
}

TEST(SessionProtocol, FailedWelcomeLeavesTheViewerOutside) {
  Conversation talk;
  talk.backend.onCall = [](const std::string& call) {
    if (call == "welcome") throw std::runtime_error("no scene yet");
  };
  v1::ClientMessage message;
  message.mutable_hello();
  const v1::Error error = talk.refused(message);
  EXPECT_EQ(error.code(), v1::Error::FAILED);
  EXPECT_EQ(error.message(), "no scene yet");
  EXPECT_FALSE(talk.protocol.joined());
  talk.protocol.onEnd();
  EXPECT_THAT(talk.backend.calls, ElementsAre("welcome"));
}

TEST(SessionProtocol, SequenceNumbersMustRise) {
  Conversation talk;
  talk.hello();
  talk.sequence = 10;
  EXPECT_EQ(talk.say(ping()).at(0).in_reply_to(), 11U);
  for (const std::uint64_t stale : {std::uint64_t{10}, std::uint64_t{4}}) {
    talk.sequence = stale;
    const v1::Error error = talk.refused(play());
    EXPECT_EQ(error.code(), v1::Error::INVALID);
    EXPECT_EQ(error.field_path(), "sequence");
  }
  EXPECT_THAT(talk.backend.calls, IsEmpty());
  talk.sequence = 11;
  EXPECT_TRUE(talk.say(ping()).at(0).has_pong());
}

TEST(SessionProtocol, MalformedBytesCloseWith1007) {
  Conversation talk;
  const auto close = talk.protocol.onMessage("\xff\xff\xff");
  ASSERT_TRUE(close);
  EXPECT_EQ(close->code, CloseCode::InvalidPayload);
  EXPECT_TRUE(talk.sent().empty());
}

TEST(SessionProtocol, TextClosesWith1003) {
  EXPECT_EQ(Conversation().protocol.onText().code, CloseCode::UnsupportedData);
}

TEST(SessionProtocol, MessageOfALaterVersionIsUnsupported) {
  Conversation talk;
  talk.hello();
  v1::ClientMessage future;
  // Field 99, length-delimited, empty: a member of the oneof that this version does not have.
  future.GetReflection()->MutableUnknownFields(&future)->AddLengthDelimited(99, "");
  EXPECT_EQ(talk.refused(future).code(), v1::Error::UNSUPPORTED);
  EXPECT_EQ(talk.refused({}).code(), v1::Error::UNSUPPORTED);
}

TEST(SessionProtocol, UnknownFieldsOfKnownMessagesAreIgnored) {
  Conversation talk;
  talk.hello();
  v1::ClientMessage message = play();
  v1::Control& control = *message.mutable_control();
  control.GetReflection()->MutableUnknownFields(&control)->AddVarint(77, 1);
  EXPECT_TRUE(talk.say(message).empty());
  EXPECT_THAT(talk.backend.calls, ElementsAre("control PLAY"));
}

TEST(SessionProtocol, InputErrorOfTheBackendBecomesInvalid) {
  Conversation talk;
  talk.hello();
  talk.backend.onCall = [](const std::string&) {
    throw core::InputError("scene.textproto:3:1", "fluid.viscosity", "-1 is outside [0, 100] m²/s");
  };
  const v1::Error error = talk.refused(play());
  EXPECT_EQ(error.code(), v1::Error::INVALID);
  EXPECT_EQ(error.field_path(), "fluid.viscosity");
  EXPECT_EQ(error.message(), "scene.textproto:3:1: -1 is outside [0, 100] m²/s");
  EXPECT_FALSE(talk.close);
}

TEST(SessionProtocol, OnlyFramesThatWereSentAreAcknowledged) {
  Conversation talk;
  talk.hello();
  EXPECT_EQ(talk.refused(acknowledgement(1)).field_path(), "frame_ack.frame_id");
  talk.outbox.pushFrame(1, wire("one"));
  talk.outbox.pushFrame(2, wire("two"));
  // Both wait in the outbox, and the viewer cannot have drawn what was not sent.
  v1::ClientMessage early = acknowledgement(2);
  early.set_sequence(++talk.sequence);
  talk.protocol.onMessage(early.SerializeAsString());
  EXPECT_THAT(talk.backend.calls, IsEmpty());
  talk.sent();

  EXPECT_TRUE(talk.say(acknowledgement(2)).empty());
  EXPECT_THAT(talk.backend.calls, ElementsAre("acknowledge 2"));
  // The second frame's acknowledgement was the first one's too.
  EXPECT_EQ(talk.refused(acknowledgement(1)).code(), v1::Error::INVALID);
}

TEST(SessionProtocol, SnapshotsAreBoundedUntilTheyAreAnswered) {
  Conversation talk;
  talk.hello();
  v1::ClientMessage message;
  message.mutable_snapshot()->set_width(640);
  message.mutable_snapshot()->set_height(480);
  talk.say(message);
  const std::uint64_t first = talk.sequence;
  talk.say(message);
  EXPECT_EQ(talk.refused(message).code(), v1::Error::REFUSED);
  EXPECT_EQ(talk.backend.calls.size(), 2U);
  EXPECT_FALSE(talk.backend.camera);

  talk.outbox.pushReply(wire("picture"), first);
  talk.sent();
  talk.backend.calls.clear();
  talk.say(message);
  EXPECT_THAT(talk.backend.calls, ElementsAre("snapshot 640x480"));
}

TEST(SessionProtocol, SnapshotThatTheBackendRefusesIsNoLongerUnderWay) {
  Conversation talk;
  talk.hello();
  talk.backend.onCall = [](const std::string&) { throw core::InputError("", "", "no picture now"); };
  v1::ClientMessage message;
  message.mutable_snapshot()->set_width(640);
  message.mutable_snapshot()->set_height(480);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(talk.refused(message).code(), v1::Error::INVALID);
}

TEST(SessionProtocol, RequestsWithoutContentAreInvalid) {
  Conversation talk;
  talk.hello();
  v1::ClientMessage camera;
  camera.mutable_set_camera();
  EXPECT_EQ(talk.refused(camera).field_path(), "camera");
  v1::ClientMessage load;
  load.mutable_load_scene();
  EXPECT_EQ(talk.refused(load).field_path(), "load_scene");
  v1::ClientMessage control;
  control.mutable_control();
  EXPECT_EQ(talk.refused(control).field_path(), "control.action");
  v1::ClientMessage update;
  update.mutable_update_scene()->mutable_scene();
  EXPECT_EQ(talk.refused(update).field_path(), "mask");
  EXPECT_THAT(talk.backend.calls, IsEmpty());
}

TEST(SessionProtocol, LeavesOnceIfItEverJoined) {
  Conversation talk;
  talk.protocol.onEnd();
  EXPECT_THAT(talk.backend.calls, IsEmpty());
  talk.hello();
  talk.protocol.onEnd();
  talk.protocol.onEnd();
  EXPECT_THAT(talk.backend.calls, ElementsAre("leave 5"));
  EXPECT_FALSE(talk.protocol.joined());
}

}  // namespace
}  // namespace sluice::stream::test
