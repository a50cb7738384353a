#include "sluice/client/connection.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>

#include "sluice/client/failure.h"
#include "web_socket.h"

namespace sluice::client {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;

namespace {

constexpr const char* kSubprotocol = "sluice.v1";
constexpr std::uint32_t kProtocolVersion = 1;

/// Room for a lossless picture of 3840×2160 that does not compress at all, 33 MB, and some.
constexpr std::size_t kMaxMessageBytes = 64U << 20U;

/// A server from which nothing comes for this long, not even the answer to a WebSocket ping, is gone.
constexpr std::chrono::seconds kIdleTimeout{15};

/// Messages that may wait to be taken by `receive` before reading pauses.
constexpr std::size_t kMaxArrived = 64;

}  // namespace

/// Every operation is asynchronous, because Beast's time limits cover no others, and `runUntil` waits for it. One read
/// is always under way, so that pings are answered and closing is noticed during a send as well.
class Connection::Impl {
 public:
  Impl(ServerUrl url, Clock::duration timeout, const Access& access)
      : url_(std::move(url)), timeout_(timeout), socket_(makeWebSocket(io_, url_, access)) {
    open(access.token);
    greet(access.role);
  }

  ~Impl() {
    if (!socket_->isOpen() || readError_) return;
    // The server's answer is read by the read that is under way; a server that gives none is not waited for long.
    constexpr std::chrono::seconds kFarewell{1};
    bool closed = false;
    socket_->close([&](error_code) { closed = true; });
    if (!runUntil([&] { return closed; }, Clock::now() + kFarewell)) {
      socket_->tcp().close();
      runUntil([&] { return closed; }, Clock::time_point::max());
    }
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  const ServerUrl& url() const { return url_; }
  const v1::Welcome& welcome() const { return welcome_; }
  Clock::duration timeout() const { return timeout_; }
  const std::optional<v1::Stats>& latestStats() const { return latestStats_; }

  void limitRate(double bytesPerSecond) {
    bytesPerSecond_ = bytesPerSecond;
    // Else the system takes in megabytes ahead.
    constexpr int kReceiveBufferBytes = 1 << 15;
    socket_->tcp().socket().set_option(asio::socket_base::receive_buffer_size(kReceiveBufferBytes));
  }

  std::uint64_t send(v1::ClientMessage message) {
    message.set_sequence(++sequence_);
    const std::string bytes = message.SerializeAsString();
    const std::uint32_t allowed = welcome_.limits().max_message_bytes();
    if (allowed > 0 && bytes.size() > allowed) {
      throw RequestError("a message of " + std::to_string(bytes.size()) + " bytes is too large; the server takes " +
                         std::to_string(allowed));
    }
    const error_code error = await([&](auto done) { socket_->write(bytes, std::move(done)); });
    if (error) throwEnded(error);
    return sequence_;
  }

  std::optional<v1::ServerMessage> receive(Clock::time_point deadline) {
    if (!reading_ && !readError_) startRead();
    runUntil([this] { return !arrived_.empty() || readError_; }, deadline);
    if (!arrived_.empty()) {
      std::optional<v1::ServerMessage> message = std::move(arrived_.front());
      arrived_.pop_front();
      if (message->has_stats()) latestStats_ = message->stats();
      return message;
    }
    if (readError_) throwEnded(readError_);
    return std::nullopt;
  }

 private:
  void open(const std::string& token) {
    // Resolving blocks; the system's resolver has time limits of its own.
    asio::ip::tcp::resolver resolver(io_);
    error_code unresolved;
    const auto endpoints = resolver.resolve(url_.host, std::to_string(url_.port), unresolved);
    check(unresolved);

    check(await([&](auto done) { socket_->tcp().async_connect(endpoints, std::move(done)); }));
    socket_->tcp().socket().set_option(asio::ip::tcp::no_delay(true));
    if (const error_code error = await([&](auto done) { socket_->secure(std::move(done)); })) {
      throw ConnectionError(cannotConnect() + socket_->securityProblem(error));
    }

    const WebSocket::Handshake handshake{.host = url_.authority(),
                                         .path = url_.path,
                                         .subprotocol = kSubprotocol,
                                         .token = token,
                                         .timeout = timeout_,
                                         .idleTimeout = kIdleTimeout,
                                         .maxMessageBytes = kMaxMessageBytes};
    websocket::response_type response;
    const error_code error = await([&](auto done) { socket_->handshake(handshake, response, std::move(done)); });
    if (error == websocket::error::upgrade_declined) throw ConnectionError(cannotConnect() + refusal(response));
    check(error);
  }

  static std::string refusal(const websocket::response_type& response) {
    std::string text =
        "the server answered " + std::to_string(response.result_int()) + " " + std::string(response.reason());
    if (response.result() == http::status::unauthorized) text += ": it wants another token (--token-file)";
    return text;
  }

  void greet(v1::Role role) {
    v1::ClientMessage hello;
    hello.mutable_hello()->set_client("sluice-cli");
    hello.mutable_hello()->set_role(role);
    send(std::move(hello));
    const Clock::time_point deadline = Clock::now() + timeout_;
    while (true) {
      std::optional<v1::ServerMessage> message = receive(deadline);
      if (!message) throw ConnectionError(cannotConnect() + "the server does not greet back");
      if (message->has_error()) throw ConnectionError(cannotConnect() + message->error().message());
      if (!message->has_welcome()) continue;
      welcome_ = std::move(*message->mutable_welcome());
      break;
    }
    if (welcome_.protocol_version() != kProtocolVersion) {
      throw ConnectionError(cannotConnect() + "the server speaks protocol " +
                            std::to_string(welcome_.protocol_version()) + ", this program " +
                            std::to_string(kProtocolVersion));
    }
  }

  void startRead() {
    reading_ = true;
    socket_->read(buffer_, [this](error_code error) {
      if (error) {
        reading_ = false;
        readError_ = error;
      } else if (bytesPerSecond_ > 0) {
        takeLater();
      } else {
        take();
      }
    });
  }

  /// Once the message in the buffer would have come at the limited rate.
  void takeLater() {
    const std::chrono::duration<double> transfer(static_cast<double>(buffer_.size()) / bytesPerSecond_);
    linkFree_ = std::max(linkFree_, Clock::now()) + std::chrono::duration_cast<Clock::duration>(transfer);
    pace_.expires_at(linkFree_);
    pace_.async_wait([this](error_code) { take(); });
  }

  void take() {
    reading_ = false;
    v1::ServerMessage message;
    if (!message.ParseFromArray(buffer_.data().data(), static_cast<int>(buffer_.size()))) {
      readError_ = websocket::error::bad_data_frame;
      return;
    }
    buffer_.consume(buffer_.size());
    arrived_.push_back(std::move(message));
    if (arrived_.size() < kMaxArrived) startRead();
  }

  /// Serves the socket until `done` holds; false when `deadline` passes first.
  bool runUntil(const std::function<bool()>& done, Clock::time_point deadline) {
    while (!done()) {
      io_.restart();
      if (deadline == Clock::time_point::max()) {
        io_.run_one();
      } else if (io_.run_one_until(deadline) == 0 && Clock::now() >= deadline) {
        return done();
      }
    }
    return true;
  }

  /// `start` begins an operation with the handler that it is given. Waits for its end; beast::error::timeout when that
  /// takes too long.
  template <class Start>
  error_code await(Start start) {
    std::optional<error_code> result;
    start([&result](error_code error, auto&&...) { result = error; });
    if (runUntil([&] { return result.has_value(); }, Clock::now() + timeout_)) return *result;
    // What is under way refers to this frame; so it is ended, and waited for.
    socket_->tcp().close();
    runUntil([&] { return result.has_value(); }, Clock::time_point::max());
    return beast::error::timeout;
  }

  std::string cannotConnect() const { return "cannot connect to " + url_.text() + ": "; }

  void check(error_code error) const {
    if (error) throw ConnectionError(cannotConnect() + error.message());
  }

  [[noreturn]] void throwEnded(error_code error) const {
    std::string why = error.message();
    if (error == websocket::error::closed) {
      const std::string reason = socket_->closeReason();
      why = reason.empty() ? "the server closed it" : reason;
    } else if (error == websocket::error::bad_data_frame) {
      why = "the server sent what is no message of " + std::string(kSubprotocol);
    }
    throw ConnectionError("the connection to " + url_.text() + " has ended: " + why);
  }

  const ServerUrl url_;
  const Clock::duration timeout_;
  asio::io_context io_;
  const std::unique_ptr<WebSocket> socket_;
  beast::flat_buffer buffer_;
  bool reading_ = false;
  double bytesPerSecond_ = 0;  ///< 0: no limit.
  asio::steady_timer pace_{io_};
  Clock::time_point linkFree_;  ///< When the bytes so far have come.
  error_code readError_;
  std::deque<v1::ServerMessage> arrived_;
  std::uint64_t sequence_ = 0;
  v1::Welcome welcome_;
  std::optional<v1::Stats> latestStats_;
};

Connection::Connection(const ServerUrl& url, Clock::duration timeout, const Access& access)
    : impl_(std::make_unique<Impl>(url, timeout, access)) {}
Connection::~Connection() = default;

const ServerUrl& Connection::url() const { return impl_->url(); }
const v1::Welcome& Connection::welcome() const { return impl_->welcome(); }
Connection::Clock::duration Connection::timeout() const { return impl_->timeout(); }
const std::optional<v1::Stats>& Connection::latestStats() const { return impl_->latestStats(); }
void Connection::limitRate(double bytesPerSecond) { impl_->limitRate(bytesPerSecond); }
std::uint64_t Connection::send(v1::ClientMessage message) { return impl_->send(std::move(message)); }
std::optional<v1::ServerMessage> Connection::receive(Clock::time_point deadline) { return impl_->receive(deadline); }

}  // namespace sluice::client
