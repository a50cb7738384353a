#include "web_socket.h"

#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>

#include "tls.h"

namespace sluice::client {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;

namespace {

using Plain = beast::tcp_stream;
using Secure = beast::ssl_stream<beast::tcp_stream>;

/// What both kinds have in common.
template <class NextLayer>
class WebSocketOver : public WebSocket {
 public:
  template <class... Arguments>
  explicit WebSocketOver(Arguments&&... arguments) : socket_(std::forward<Arguments>(arguments)...) {}

  beast::tcp_stream& tcp() override { return beast::get_lowest_layer(socket_); }

  void handshake(const Handshake& wanted, websocket::response_type& response, Done done) override {
    socket_.set_option(websocket::stream_base::timeout{
        .handshake_timeout = wanted.timeout, .idle_timeout = wanted.idleTimeout, .keep_alive_pings = true});
    socket_.set_option(websocket::stream_base::decorator(
        [subprotocol = wanted.subprotocol, token = wanted.token](websocket::request_type& request) {
          request.set(http::field::sec_websocket_protocol, subprotocol);
          request.set(http::field::user_agent, "sluice-cli");
          if (!token.empty()) request.set(http::field::authorization, "Bearer " + token);
        }));
    socket_.binary(true);
    socket_.auto_fragment(false);
    socket_.read_message_max(wanted.maxMessageBytes);
    socket_.async_handshake(response, wanted.host, wanted.path, std::move(done));
  }

  void write(const std::string& bytes, Done done) override {
    socket_.async_write(asio::buffer(bytes), [done = std::move(done)](error_code error, std::size_t) { done(error); });
  }

  void read(beast::flat_buffer& buffer, Done done) override {
    socket_.async_read(buffer, [done = std::move(done)](error_code error, std::size_t) { done(error); });
  }

  void close(Done done) override { socket_.async_close(websocket::close_code::normal, std::move(done)); }

  bool isOpen() const override { return socket_.is_open(); }

  std::string closeReason() const override {
    const auto& reason = socket_.reason().reason;
    return {reason.data(), reason.size()};
  }

 protected:
  websocket::stream<NextLayer> socket_;
};

class PlainWebSocket final : public WebSocketOver<Plain> {
 public:
  explicit PlainWebSocket(asio::io_context& io) : WebSocketOver(io) {}

  void secure(Done done) override {
    asio::post(socket_.get_executor(), [done = std::move(done)] { done({}); });
  }
  std::string securityProblem(error_code error) const override { return error.message(); }
};

/// Keeps the context that its stream refers to.
struct TlsContext {
  asio::ssl::context context;
};

class SecureWebSocket final : private TlsContext, public WebSocketOver<Secure> {
 public:
  SecureWebSocket(asio::io_context& io, const std::string& host, const Access& access)
      : TlsContext{makeTlsContext(access)}, WebSocketOver(io, context) {
    expectHost(native(), host, access.verify);
  }

  void secure(Done done) override {
    socket_.next_layer().async_handshake(asio::ssl::stream_base::client, std::move(done));
  }

  std::string securityProblem(error_code error) const override {
    const std::string problem = certificateProblem(native());
    if (problem.empty()) return "TLS: " + error.message();
    return "its certificate is not trusted: " + problem +
           " (--ca-file names certificates to trust, --insecure goes without)";
  }

 private:
  SSL* native() const { return const_cast<Secure&>(socket_.next_layer()).native_handle(); }
};

}  // namespace

std::unique_ptr<WebSocket> makeWebSocket(asio::io_context& io, const ServerUrl& url, const Access& access) {
  if (url.tls) return std::make_unique<SecureWebSocket>(io, url.host, access);
  return std::make_unique<PlainWebSocket>(io);
}

}  // namespace sluice::client
