#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/v1/session.pb.h"

namespace sluice::test {

/// Long enough for a loaded machine with sanitizers; nothing waits for it unless the test fails anyway.
inline constexpr std::chrono::milliseconds kPatience{20'000};

/// The server answered the handshake with something else than 101.
struct HandshakeRefused : std::runtime_error {
  HandshakeRefused(int httpStatus, const std::string& text)
      : std::runtime_error(std::to_string(httpStatus) + " " + text), status(httpStatus), body(text) {}
  int status;
  std::string body;
};

/// The connection has ended. `code` is that of the close frame, 0 where none came.
struct ConnectionEnded : std::runtime_error {
  ConnectionEnded(std::uint16_t closeCode, const std::string& closeReason)
      : std::runtime_error("closed with " + std::to_string(closeCode) + " " + closeReason),
        code(closeCode),
        reason(closeReason) {}
  std::uint16_t code;
  std::string reason;
};

struct TimedOut : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ConnectOptions {
  std::string target = "/stream";
  std::string subprotocol = "sluice.v1";  ///< Empty: none is offered.
  std::string origin{};                   ///< Empty: none is sent.
  std::string token{};                    ///< In an Authorization header; empty: none is sent.
  int receiveBufferBytes = 0;             ///< Of the socket; 0 leaves the system's.
};

/// A viewer that blocks: each call returns when it is done, or throws TimedOut after kPatience. Reads from the socket
/// only inside calls that receive, so a test that does not call them is a viewer that has stopped reading.
/// For one thread.
class TestViewer {
 public:
  TestViewer();
  TestViewer(const std::string& host, std::uint16_t port, const ConnectOptions& options = {});
  ~TestViewer();
  TestViewer(TestViewer&&) noexcept;
  TestViewer& operator=(TestViewer&&) noexcept;

  /// Throws HandshakeRefused, or std::system_error where nobody listens.
  void connect(const std::string& host, std::uint16_t port, const ConnectOptions& options = {});

  /// Fills in the sequence number unless it is set, and returns it.
  std::uint64_t send(v1::ClientMessage message);
  void sendBinary(std::string_view bytes);
  void sendText(std::string_view text);

  /// The next message; none after `timeout`. Throws ConnectionEnded.
  std::optional<v1::ServerMessage> tryReceive(std::chrono::milliseconds timeout);

  /// The next message. Throws TimedOut or ConnectionEnded.
  v1::ServerMessage receive();

  /// Skips messages until one of this kind comes.
  v1::ServerMessage receive(v1::ServerMessage::MessageCase kind);

  /// Skips messages until one comes that answers `sequence`.
  v1::ServerMessage receiveReply(std::uint64_t sequence);

  // Conversations.

  /// Says Hello and returns the answer.
  v1::Welcome hello(const std::string& client = "test");
  /// Says Hello with a token and a wish for a role.
  v1::Welcome helloAs(v1::Role role, const std::string& token = {});
  std::uint64_t setView(std::uint32_t width, std::uint32_t height, const std::vector<v1::Codec>& codecs = {},
                        std::uint32_t quality = 0, double maxRate = 0);
  std::uint64_t setCamera(const v1::Camera& camera);
  void acknowledge(std::uint64_t frameId);

  /// The next frame that is no snapshot, acknowledged if wished.
  v1::Frame nextFrame(bool acknowledged = true);

  /// Frames, each acknowledged, until one reflects `sequence`.
  v1::Frame frameReflecting(std::uint64_t sequence);

  /// Receives until the connection ends, and says how.
  ConnectionEnded waitForEnd();

  /// Closes with a close frame and waits for the answer.
  void close();

  /// Ends the connection without a word: with a reset, as from a process that was killed.
  void vanish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
  std::uint64_t lastSequence_ = 0;
};

}  // namespace sluice::test
