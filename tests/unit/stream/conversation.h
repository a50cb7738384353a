#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "outbox.h"
#include "recording_backend.h"
#include "session_protocol.h"
#include "wire.h"

namespace sluice::stream::test {

/// A viewer, its protocol and its outbox, without a socket between them.
class Conversation {
 public:
  explicit Conversation(Access admits = {}, std::string shownToken = {})
      : access(std::move(admits)),
        outbox({.frameWindow = 2}),
        protocol(5, limits(), access, std::move(shownToken), backend, outbox) {}

  static v1::Limits limits() {
    v1::Limits limits;
    limits.set_max_width(1920);
    limits.set_max_height(1080);
    limits.set_max_message_bytes(1U << 20U);
    limits.set_frame_window(2);
    limits.set_max_rate(60);
    return limits;
  }

  /// Everything that the outbox would send now.
  std::vector<v1::ServerMessage> sent() {
    std::vector<v1::ServerMessage> messages;
    while (auto item = outbox.next()) {
      if (!std::holds_alternative<WireMessage>(*item)) break;
      messages.emplace_back().ParseFromString(*std::get<WireMessage>(*item));
    }
    return messages;
  }

  /// Sends a message with the next sequence number and returns what comes back.
  std::vector<v1::ServerMessage> say(v1::ClientMessage message) {
    message.set_sequence(++sequence);
    close = protocol.onMessage(message.SerializeAsString());
    return sent();
  }

  /// Says it and returns the one Error that it must get.
  v1::Error refused(v1::ClientMessage message) {
    const std::vector<v1::ServerMessage> answers = say(std::move(message));
    if (answers.size() != 1 || !answers[0].has_error() || answers[0].in_reply_to() != sequence) return {};
    return answers[0].error();
  }

  std::vector<v1::ServerMessage> hello() {
    v1::ClientMessage message;
    message.mutable_hello()->set_client("test");
    auto answers = say(std::move(message));
    backend.calls.clear();
    return answers;
  }

  RecordingBackend backend;
  const Access access;
  Outbox outbox;
  SessionProtocol protocol;
  std::uint64_t sequence = 0;
  std::optional<CloseReason> close;
};

}  // namespace sluice::stream::test
