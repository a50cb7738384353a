#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <memory>
#include <string>

#include "message_budget.h"
#include "outbox.h"
#include "server_context.h"
#include "session_protocol.h"
#include "transport.h"

namespace sluice::stream {

/// One viewer's WebSocket: reads messages for the protocol, writes what the outbox holds, one message at a time, and
/// drops a viewer that takes no bytes. Lives on the strand of its transport until the connection ends.
class Session : public std::enable_shared_from_this<Session> {
 public:
  using Upgrade = beast::http::request<beast::http::string_body>;

  /// `shownToken` is what the handshake carried, or empty.
  Session(core::ViewerId viewer, Transport&& transport, std::string shownToken, ServerContext& context);

  /// Accepts the handshake, then serves the viewer until the connection ends. Call once, on the strand.
  asio::awaitable<void> run(Upgrade upgrade);

  // Thread-safe.

  SendResult sendFrame(std::uint64_t frameId, WireMessage message);
  SendResult sendReply(WireMessage message, std::uint64_t inReplyTo);
  SendResult sendLatest(Outbox::Latest kind, WireMessage message);

  /// Sends a close frame with the reason; a viewer that does not answer it within two seconds is cut off.
  void close(CloseReason reason);

  /// Whether the viewer has said Hello.
  bool joined() const { return protocol_.joined(); }

 private:
  using Clock = std::chrono::steady_clock;

  void configure();
  asio::awaitable<std::string> readMessages();
  asio::awaitable<void> keepBudget();
  asio::awaitable<void> writeMessages();
  asio::awaitable<void> watch();
  asio::awaitable<bool> write(const std::string& message);

  SendResult woken(SendResult result);
  void wakeWriter();
  void cutOff(std::string why);

  const core::ViewerId viewer_;
  ServerContext& context_;
  const std::string peer_;
  beast::websocket::stream<Transport, /*deflateSupported=*/false> socket_;
  Outbox outbox_;
  SessionProtocol protocol_;
  beast::flat_buffer incoming_;
  MessageBudget budget_;
  const Clock::time_point connected_ = Clock::now();
  asio::steady_timer wake_;   // Never expires; cancelled to wake the writer.
  asio::steady_timer check_;  // Paces `watch`.
  bool ended_ = false;
  bool writing_ = false;
  Clock::time_point writeStarted_;
  Clock::time_point closeBy_ = Clock::time_point::max();
  std::string cutOffReason_;
};

}  // namespace sluice::stream
