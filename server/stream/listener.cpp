#include "listener.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/strand.hpp>
#include <cctype>
#include <exception>
#include <string>
#include <utility>

#include "sluice/core/input_error.h"

namespace sluice::stream {

using asio::ip::tcp;

namespace {

// Connections that speak HTTP at one time; a browser opens six.
constexpr std::size_t kMaxHttpConnections = 256;
// How long to wait when the process is out of file descriptors.
constexpr std::chrono::milliseconds kAcceptPause{100};

[[noreturn]] void cannotListen(const ServerOptions& options, const beast::error_code& error) {
  std::string why = error.message();
  if (!why.empty()) why[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(why[0])));
  const bool isV6 = options.address.find(':') != std::string::npos;
  throw core::EnvironmentError("cannot listen on " + (isV6 ? "[" + options.address + "]" : options.address) + ":" +
                               std::to_string(options.port) + ": " + why);
}

tcp::endpoint resolved(asio::io_context& io, const ServerOptions& options) {
  beast::error_code error;
  const auto results = tcp::resolver(io).resolve(options.address, std::to_string(options.port),
                                                 tcp::resolver::passive | tcp::resolver::numeric_service, error);
  if (error) cannotListen(options, error);
  return results.begin()->endpoint();
}

}  // namespace

Listener::Listener(asio::io_context& io, ServerContext& context)
    : io_(io), context_(context), acceptor_(io), pause_(io) {
  const tcp::endpoint endpoint = resolved(io, context.options);
  beast::error_code error;
  acceptor_.open(endpoint.protocol(), error);
  // Lets a restarted server have the port while connections of the last one linger in TIME_WAIT.
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(tcp::acceptor::max_listen_connections, error);
  if (!error) port_ = acceptor_.local_endpoint(error).port();
  if (error) cannotListen(context.options, error);
}

void Listener::start() {
  asio::co_spawn(io_, accept(), [](const std::exception_ptr& failure) {
    if (failure) std::rethrow_exception(failure);
  });
}

void Listener::stop() {
  beast::error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
  for (const auto& [id, weak] : connections_) {
    if (const auto connection = weak.lock()) connection->cutOff();
  }
}

asio::awaitable<void> Listener::accept() {
  while (acceptor_.is_open()) {
    auto [error, socket] = co_await acceptor_.async_accept(asio::make_strand(io_), kAsTuple);
    if (!acceptor_.is_open()) break;
    if (error) {
      // A connection that its peer gave up again, or no file descriptor left: others may fare better, a little later.
      pause_.expires_after(kAcceptPause);
      co_await pause_.async_wait(kAsTuple);
      continue;
    }
    if (connections_.size() < kMaxHttpConnections) serve(std::move(socket));
  }
}

void Listener::serve(tcp::socket socket) {
  beast::error_code ignored;
  // Small messages go out at once rather than wait for the acknowledgement of what went before (Nagle's algorithm).
  socket.set_option(tcp::no_delay(true), ignored);

  context_.counters.connections.fetch_add(1, std::memory_order_relaxed);
  const std::uint64_t id = ++lastConnection_;
  const auto executor = socket.get_executor();
  const auto connection = std::make_shared<HttpConnection>(std::move(socket), context_);
  connections_.emplace(id, connection);
  // One io thread runs every strand, so the map needs no lock.
  asio::co_spawn(executor, connection->run(), [this, id](const std::exception_ptr&) { connections_.erase(id); });
}

}  // namespace sluice::stream
