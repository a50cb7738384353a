#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sluice/client/server_url.h"
#include "sluice/v1/session.pb.h"

namespace sluice::client {

/// What a fake server does about a message.
struct Reaction {
  std::vector<v1::ServerMessage> messages = {};
  std::string bytes = {};  ///< Sent as a message of its own behind the others, when not empty.
  bool close = false;      ///< Then the server closes the connection, saying "enough".
};

/// A server of one's own making on a free port of 127.0.0.1, for as long as it lives.
class FakeServer {
 public:
  using React = std::function<Reaction(const v1::ClientMessage&)>;

  /// `react` is called on the server's thread.
  explicit FakeServer(React react);
  /// Answers every upgrade with this HTTP status instead.
  explicit FakeServer(int httpStatus);
  ~FakeServer();
  FakeServer(const FakeServer&) = delete;
  FakeServer& operator=(const FakeServer&) = delete;

  ServerUrl url() const;

  /// Everything received so far, of all connections. Thread-safe.
  std::vector<v1::ClientMessage> received() const;

  /// The Authorization header of the newest handshake; empty where it had none. Thread-safe.
  std::string authorization() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A server that greets, takes everything, and tells a paused simulation before each Pong.
Reaction oblige(const v1::ClientMessage& message);

/// The answer to a message: its in_reply_to is set.
v1::ServerMessage replyTo(const v1::ClientMessage& message);

v1::Welcome someWelcome();
v1::Stats someStats();

}  // namespace sluice::client
