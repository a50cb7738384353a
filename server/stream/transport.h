#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

namespace sluice::stream {

namespace asio = boost::asio;
namespace beast = boost::beast;

/// Makes `co_await` give a tuple that starts with the error code, instead of throwing.
inline constexpr auto kAsTuple = asio::as_tuple(asio::use_awaitable);

/// Remembers when a connection last took bytes of ours, however far a message is. Takes the place of a rate policy in
/// Beast's stream, which is told of every transfer, and limits nothing.
class WriteProgress {
 public:
  std::chrono::steady_clock::time_point lastWrite() const { return lastWrite_; }

 private:
  friend class beast::rate_policy_access;

  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  // Names that Beast's RatePolicy concept gives.
  std::size_t available_read_bytes() const { return kUnlimited; }
  std::size_t available_write_bytes() const { return kUnlimited; }
  void transfer_read_bytes(std::size_t) const {}
  void transfer_write_bytes(std::size_t) { lastWrite_ = std::chrono::steady_clock::now(); }
  void on_timer() const {}

  std::chrono::steady_clock::time_point lastWrite_;
};

/// A TCP connection on its strand, with TLS over it where the server has a certificate. An AsyncStream in Asio's terms,
/// one type for both, so that all that stands on it is compiled once. Movable.
class Transport {
 public:
  using Tcp = beast::basic_stream<asio::ip::tcp, asio::any_io_executor, WriteProgress>;
  using executor_type = Tcp::executor_type;  // NOLINT(readability-identifier-naming): Asio's name.

  /// Whether the operation that is about to begin is to fail, for tests; empty for none.
  using Faults = std::function<bool()>;

  /// `tls` is null for a plain connection; else it must outlive the transport, as must `faults`.
  Transport(asio::ip::tcp::socket socket, asio::ssl::context* tls, const Faults& faults)
      : tcp_(std::make_unique<Tcp>(std::move(socket))), faults_(faults ? &faults : nullptr) {
    if (tls != nullptr) tls_ = std::make_unique<Tls>(*tcp_, *tls);
  }

  executor_type get_executor() { return tcp_->get_executor(); }
  Tcp& tcp() { return *tcp_; }
  const Tcp& tcp() const { return *tcp_; }
  bool encrypted() const { return tls_ != nullptr; }

  /// To be done before anything is read or written. Nothing to do for a plain connection.
  asio::awaitable<beast::error_code> handshake() {
    if (!tls_) co_return beast::error_code();
    const auto [error] = co_await tls_->async_handshake(asio::ssl::stream_base::server, kAsTuple);
    co_return error;
  }

  void close() { tcp_->close(); }

  template <class Buffers, class Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    failIfAsked();
    return tls_ ? tls_->async_read_some(buffers, std::forward<Token>(token))
                : tcp_->async_read_some(buffers, std::forward<Token>(token));
  }

  template <class Buffers, class Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    failIfAsked();
    return tls_ ? tls_->async_write_some(buffers, std::forward<Token>(token))
                : tcp_->async_write_some(buffers, std::forward<Token>(token));
  }

  // What Beast's WebSocket calls, by argument-dependent look-up, when a connection ends.

  friend void teardown(beast::role_type role, Transport& transport, beast::error_code& error) {
    using beast::websocket::teardown;
    teardown(role, transport.tcp_->socket(), error);
  }

  template <class Handler>
  friend void async_teardown(beast::role_type role, Transport& transport, Handler&& handler) {
    using beast::websocket::async_teardown;
    if (transport.tls_) {
      async_teardown(role, *transport.tls_, std::forward<Handler>(handler));
    } else {
      async_teardown(role, *transport.tcp_, std::forward<Handler>(handler));
    }
  }

  friend void beast_close_socket(Transport& transport) { transport.close(); }

 private:
  using Tls = asio::ssl::stream<Tcp&>;

  // What begins on a closed socket fails.
  void failIfAsked() {
    if (faults_ != nullptr && (*faults_)()) close();
  }

  std::unique_ptr<Tcp> tcp_;
  std::unique_ptr<Tls> tls_;
  const Faults* faults_;
};

}  // namespace sluice::stream
