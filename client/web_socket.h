#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket.hpp>

#include "sluice/client/connection.h"
#include "sluice/client/server_url.h"

namespace sluice::client {

/// A WebSocket over TCP or over TLS. Every operation is asynchronous and hands its result to `done`; what it is given
/// by reference has to live until then. For one thread at a time.
class WebSocket {
 public:
  using Done = std::function<void(boost::beast::error_code)>;

  struct Handshake {
    std::string host;  ///< host:port, for the Host header.
    std::string path;
    std::string subprotocol;
    std::string token;  ///< None is shown where it is empty.
    std::chrono::steady_clock::duration timeout;
    std::chrono::steady_clock::duration idleTimeout;
    std::size_t maxMessageBytes;
  };

  virtual ~WebSocket() = default;
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

  /// The layer at the bottom, to connect and to cut.
  virtual boost::beast::tcp_stream& tcp() = 0;

  /// The handshake of TLS; nothing where there is none.
  virtual void secure(Done done) = 0;
  /// What `secure` failed of, in words.
  virtual std::string securityProblem(boost::beast::error_code error) const = 0;

  virtual void handshake(const Handshake& wanted, boost::beast::websocket::response_type& response, Done done) = 0;
  virtual void write(const std::string& bytes, Done done) = 0;
  virtual void read(boost::beast::flat_buffer& buffer, Done done) = 0;
  virtual void close(Done done) = 0;

  virtual bool isOpen() const = 0;
  /// What the server gave as its reason for closing; may be empty.
  virtual std::string closeReason() const = 0;

 protected:
  WebSocket() = default;
};

/// Over TLS where the URL says so. `io` outlives it. Throws UsageError for a file of certificates that cannot be used.
std::unique_ptr<WebSocket> makeWebSocket(boost::asio::io_context& io, const ServerUrl& url, const Access& access);

}  // namespace sluice::client
