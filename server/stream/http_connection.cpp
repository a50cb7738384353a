#include "http_connection.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <utility>

#include "session.h"

namespace sluice::stream {

namespace http = beast::http;

namespace {

// For a whole request, and for the next one on a connection that stays open.
constexpr std::chrono::seconds kRequestTimeout{15};
// For a response; the largest is some file of the page.
constexpr std::chrono::seconds kResponseTimeout{60};
constexpr std::chrono::seconds kDrainTimeout{1};
constexpr std::uint32_t kMaxHeaderBytes = 16 * 1024;
// No request that is answered here has a body.
constexpr std::uint64_t kMaxBodyBytes = 1024;

// What a request that cannot be read is told; none where nobody is left to tell.
std::optional<http::status> statusOf(const beast::error_code& error) {
  if (error == http::error::header_limit) return http::status::request_header_fields_too_large;
  if (error == http::error::body_limit) return http::status::payload_too_large;
  if (error == http::error::end_of_stream || error == http::error::partial_message) return std::nullopt;
  if (error.category() == make_error_code(http::error::bad_method).category()) return http::status::bad_request;
  return std::nullopt;
}

}  // namespace

HttpConnection::HttpConnection(asio::ip::tcp::socket socket, ServerContext& context)
    : context_(context),
      transport_(std::move(socket), context.tls ? &*context.tls : nullptr, context.options.failsNow),
      buffer_(kMaxHeaderBytes + kMaxBodyBytes) {}

asio::awaitable<void> HttpConnection::run() {
  const auto self = shared_from_this();
  transport_.tcp().expires_after(kRequestTimeout);
  if (co_await transport_.handshake()) co_return;
  for (;;) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(kMaxHeaderBytes);
    parser.body_limit(kMaxBodyBytes);
    transport_.tcp().expires_after(kRequestTimeout);
    const auto [error, bytes] = co_await http::async_read(transport_, buffer_, parser, kAsTuple);
    if (error) {
      if (const auto status = statusOf(error)) {
        HttpRequest unreadable;
        unreadable.keep_alive(false);
        co_await answer(plainResponse(unreadable, *status, "the request cannot be read"));
        co_await drain();
      }
      co_return;
    }
    HttpRequest request = parser.release();
    if (beast::websocket::is_upgrade(request)) {
      if (auto refusal = upgrade(std::move(request))) co_await answer(*std::move(refusal));
      co_return;
    }
    if (!co_await answer(respond(request, context_))) co_return;
  }
}

asio::awaitable<bool> HttpConnection::answer(HttpResponse response) {
  transport_.tcp().expires_after(kResponseTimeout);
  const bool keepAlive = response.keep_alive();
  const auto [error, bytes] = co_await http::async_write(transport_, response, kAsTuple);
  if (error || !keepAlive) {
    beast::error_code ignored;
    transport_.tcp().socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    co_return false;
  }
  co_return true;
}

asio::awaitable<void> HttpConnection::drain() {
  // Closing a socket with unread bytes resets the connection, and the peer may lose the answer; so it gets a moment.
  transport_.tcp().expires_after(kDrainTimeout);
  for (;;) {
    buffer_.clear();
    const auto [error, bytes] = co_await transport_.async_read_some(buffer_.prepare(kMaxHeaderBytes), kAsTuple);
    if (error) co_return;
  }
}

std::optional<HttpResponse> HttpConnection::upgrade(HttpRequest request) {
  beast::error_code ignored;
  const std::string address = transport_.tcp().socket().remote_endpoint(ignored).address().to_string();
  if (auto refusal = refuseHandshake(request, address, context_)) {
    context_.counters.refusedHandshakes.fetch_add(1, std::memory_order_relaxed);
    context_.log({"handshake_refused", {{"peer", address}, {"status", std::to_string(refusal->result_int())}}});
    refusal->keep_alive(false);
    return refusal;
  }
  const core::ViewerId viewer = context_.registry.newId();
  const auto executor = transport_.get_executor();
  const auto session = std::make_shared<Session>(viewer, std::move(transport_), shownToken(request), context_);
  context_.registry.add(viewer, session, address);
  asio::co_spawn(executor, session->run(std::move(request)), asio::detached);
  return std::nullopt;
}

void HttpConnection::cutOff() { transport_.close(); }

}  // namespace sluice::stream
