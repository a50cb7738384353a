#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <map>
#include <memory>

#include "http_connection.h"
#include "server_context.h"

namespace sluice::stream {

/// Accepts connections, up to a bound, and remembers those that still speak HTTP so that `stop` can end them.
/// Used on the io thread alone once `start` was called.
class Listener {
 public:
  /// Opens the port. Throws core::EnvironmentError where that fails.
  Listener(asio::io_context& io, ServerContext& context);

  std::uint16_t port() const { return port_; }

  void start();

  /// Takes no more connections and ends those that still speak HTTP.
  void stop();

 private:
  asio::awaitable<void> accept();
  void serve(asio::ip::tcp::socket socket);

  asio::io_context& io_;
  ServerContext& context_;
  asio::ip::tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  std::uint16_t port_ = 0;
  std::uint64_t lastConnection_ = 0;
  std::map<std::uint64_t, std::weak_ptr<HttpConnection>> connections_;
};

}  // namespace sluice::stream
