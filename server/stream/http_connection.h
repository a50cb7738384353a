#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <memory>
#include <optional>

#include "http_responder.h"
#include "server_context.h"
#include "transport.h"

namespace sluice::stream {

/// One TCP connection while it speaks HTTP: answers requests until it ends or becomes a Session.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(asio::ip::tcp::socket socket, ServerContext& context);

  /// Call once, on the strand of the socket.
  asio::awaitable<void> run();

  /// Ends it whatever it does; a Session that it became is not touched. On the strand.
  void cutOff();

 private:
  asio::awaitable<bool> answer(HttpResponse response);
  asio::awaitable<void> drain();
  /// Hands the connection to a new Session, or says why not.
  std::optional<HttpResponse> upgrade(HttpRequest request);

  ServerContext& context_;
  Transport transport_;
  beast::flat_buffer buffer_;
};

}  // namespace sluice::stream
