#include "session.h"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <exception>
#include <sstream>
#include <utility>

namespace sluice::stream {

namespace websocket = beast::websocket;
namespace http = beast::http;

namespace {

constexpr std::chrono::seconds kHandshakeTimeout{10};
constexpr std::chrono::milliseconds kLongestTick{500};
// How long a viewer may take to answer a close frame.
constexpr std::chrono::seconds kCloseTimeout{2};
// Bytes of text that fit into a close frame, RFC 6455 section 5.5.1.
constexpr std::size_t kMaxCloseText = 123;

std::string describePeer(const Transport& transport) {
  beast::error_code error;
  const auto endpoint = transport.tcp().socket().remote_endpoint(error);
  if (error) return "an unknown address";
  std::ostringstream text;
  text << endpoint;
  return text.str();
}

v1::Limits limitsOf(const ServerOptions& options) {
  v1::Limits limits;
  limits.set_max_width(static_cast<std::uint32_t>(options.maxSize.width));
  limits.set_max_height(static_cast<std::uint32_t>(options.maxSize.height));
  limits.set_max_message_bytes(options.maxMessageBytes);
  limits.set_frame_window(options.frameWindow);
  limits.set_max_rate(options.maxRate);
  limits.set_max_message_rate(options.maxMessageRate);
  limits.set_max_particles(options.maxParticles);
  return limits;
}

std::string describeEnd(const beast::error_code& error, const websocket::close_reason& reason) {
  if (error != websocket::error::closed) return error.message();
  return "closed with " + std::to_string(reason.code);
}

}  // namespace

Session::Session(core::ViewerId viewer, Transport&& transport, std::string shownToken, ServerContext& context)
    : viewer_(viewer),
      context_(context),
      peer_(describePeer(transport)),
      socket_(std::move(transport)),
      outbox_({.frameWindow = context.options.frameWindow}),
      protocol_(viewer, limitsOf(context.options), context.options.access, std::move(shownToken), context.backend,
                outbox_),
      incoming_(context.options.maxMessageBytes),
      budget_(context.options.maxMessageRate, Clock::now()),
      wake_(socket_.get_executor(), Clock::time_point::max()),
      check_(socket_.get_executor()) {}

void Session::configure() {
  socket_.next_layer().tcp().expires_never();  // The WebSocket has timeouts of its own.
  socket_.set_option(websocket::stream_base::timeout{
      .handshake_timeout = kHandshakeTimeout, .idle_timeout = context_.options.idleTimeout, .keep_alive_pings = true});
  socket_.set_option(websocket::stream_base::decorator(
      [](websocket::response_type& response) { response.set(http::field::sec_websocket_protocol, kSubprotocol); }));
  socket_.read_message_max(context_.options.maxMessageBytes);
  socket_.auto_fragment(false);
  socket_.binary(true);
}

asio::awaitable<void> Session::run(Upgrade upgrade) {
  const auto self = shared_from_this();
  configure();
  const auto [refused] = co_await socket_.async_accept(upgrade, kAsTuple);
  if (!refused) {
    context_.log({"viewer_connected", {{"viewer", std::to_string(viewer_)}, {"peer", peer_}}});
    const auto executor = socket_.get_executor();
    asio::co_spawn(
        executor, [self] { return self->writeMessages(); }, asio::detached);
    asio::co_spawn(
        executor, [self] { return self->watch(); }, asio::detached);
    std::string why;
    try {
      why = co_await readMessages();
    } catch (const std::exception& error) {  // Out of memory, say: this viewer's end, not the server's.
      why = error.what();
    }
    context_.log({"viewer_left",
                  {{"viewer", std::to_string(viewer_)},
                   {"client", protocol_.client()},
                   {"reason", cutOffReason_.empty() ? why : cutOffReason_}}});
  }
  ended_ = true;
  outbox_.close({});
  context_.registry.remove(viewer_);
  protocol_.onEnd();
  wake_.cancel();
  check_.cancel();
  socket_.next_layer().close();
}

asio::awaitable<std::string> Session::readMessages() {
  for (;;) {
    incoming_.clear();
    const auto [error, bytes] = co_await socket_.async_read(incoming_, kAsTuple);
    if (error) co_return describeEnd(error, socket_.reason());
    // What a viewer says after we began to close no longer counts; reading on finds its answer to the close frame.
    if (outbox_.closed()) continue;

    context_.counters.messagesReceived.fetch_add(1, std::memory_order_relaxed);
    std::optional<CloseReason> reason;
    if (socket_.got_binary()) {
      const auto data = incoming_.cdata();
      reason = protocol_.onMessage({static_cast<const char*>(data.data()), bytes});
    } else {
      reason = protocol_.onText();
    }
    if (reason) outbox_.close(*std::move(reason));
    wakeWriter();
    co_await keepBudget();
  }
}

asio::awaitable<void> Session::keepBudget() {
  const Clock::duration wait = budget_.take(Clock::now());
  if (wait <= Clock::duration::zero()) co_return;
  // Not reading is what slows the viewer down, and nobody else.
  asio::steady_timer pause(socket_.get_executor(), wait);
  co_await pause.async_wait(kAsTuple);
}

asio::awaitable<void> Session::writeMessages() {
  const auto self = shared_from_this();
  while (!ended_) {
    const std::optional<Outbox::Item> item = outbox_.next();
    if (!item) {
      co_await wake_.async_wait(kAsTuple);
      continue;
    }
    if (const auto* message = std::get_if<WireMessage>(&*item)) {
      if (!co_await write(**message)) co_return;
      continue;
    }
    const auto& reason = std::get<CloseReason>(*item);
    if (!socket_.is_open()) co_return;
    const websocket::close_reason frame(static_cast<websocket::close_code>(reason.code),
                                        beast::string_view(reason.text).substr(0, kMaxCloseText));
    co_await socket_.async_close(frame, kAsTuple);
    co_return;
  }
}

asio::awaitable<bool> Session::write(const std::string& message) {
  writing_ = true;
  writeStarted_ = Clock::now();
  const auto [error, bytes] = co_await socket_.async_write(asio::buffer(message), kAsTuple);
  writing_ = false;
  context_.counters.bytesSent.fetch_add(bytes, std::memory_order_relaxed);
  if (error) cutOff("cannot write: " + error.message());
  co_return !error;
}

asio::awaitable<void> Session::watch() {
  const auto self = shared_from_this();
  const Clock::duration writeTimeout = context_.options.writeTimeout;
  // Often enough that a timeout is found within a quarter of itself.
  const Clock::duration helloTimeout = context_.options.helloTimeout;
  const Clock::duration tick = std::min<Clock::duration>(std::min(writeTimeout, helloTimeout) / 4, kLongestTick);
  while (!ended_) {
    if (context_.options.failsNow && context_.options.failsNow()) cutOff("a timer failed");
    check_.expires_after(tick);
    co_await check_.async_wait(kAsTuple);
    if (ended_) break;
    const auto now = Clock::now();
    if (now >= closeBy_) {
      cutOff("did not answer the close frame");
    } else if (!protocol_.joined() && now - connected_ >= helloTimeout) {
      close({CloseCode::PolicyViolation, "no Hello has come"});
    } else if (writing_ &&
               now - std::max(writeStarted_, socket_.next_layer().tcp().rate_policy().lastWrite()) >= writeTimeout) {
      cutOff("took no bytes for too long");
    }
  }
}

SendResult Session::sendFrame(std::uint64_t frameId, WireMessage message) {
  return woken(outbox_.pushFrame(frameId, std::move(message)));
}

SendResult Session::sendReply(WireMessage message, std::uint64_t inReplyTo) {
  return woken(outbox_.pushReply(std::move(message), inReplyTo));
}

SendResult Session::sendLatest(Outbox::Latest kind, WireMessage message) {
  return woken(outbox_.pushLatest(kind, std::move(message)));
}

void Session::close(CloseReason reason) {
  outbox_.close(std::move(reason));
  woken(SendResult::Sent);
}

SendResult Session::woken(SendResult result) {
  if (result == SendResult::Sent || result == SendResult::Overflow) {
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->wakeWriter(); });
  }
  return result;
}

void Session::wakeWriter() {
  if (outbox_.closed() && closeBy_ == Clock::time_point::max()) closeBy_ = Clock::now() + kCloseTimeout;
  wake_.cancel();
}

void Session::cutOff(std::string why) {
  if (cutOffReason_.empty()) cutOffReason_ = std::move(why);
  // The reader ends with an error, and with it the session.
  socket_.next_layer().close();
}

}  // namespace sluice::stream
