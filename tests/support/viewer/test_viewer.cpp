#include "test_viewer.h"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <utility>

namespace sluice::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;

class TestViewer::Impl {
 public:
  void connect(const std::string& host, std::uint16_t port, const ConnectOptions& options) {
    const tcp::endpoint endpoint(asio::ip::make_address(host), port);
    tcp::socket& socket = socket_.next_layer();
    socket.open(endpoint.protocol());
    if (options.receiveBufferBytes > 0) {
      // Before connecting, since the window that TCP announces depends on it.
      socket.set_option(tcp::socket::receive_buffer_size(options.receiveBufferBytes));
    }
    socket.connect(endpoint);
    socket.set_option(tcp::no_delay(true));

    socket_.set_option(websocket::stream_base::decorator([options](websocket::request_type& request) {
      namespace http = beast::http;
      if (!options.subprotocol.empty()) request.set(http::field::sec_websocket_protocol, options.subprotocol);
      if (!options.origin.empty()) request.set(http::field::origin, options.origin);
      if (!options.token.empty()) request.set(http::field::authorization, "Bearer " + options.token);
    }));
    socket_.read_message_max(std::size_t{256} << 20U);
    socket_.binary(true);

    websocket::response_type response;
    const std::string hostField = host + ":" + std::to_string(port);
    const error_code error = finish("the handshake", [&](auto done) {
      socket_.async_handshake(response, hostField, options.target, std::move(done));
    });
    if (error == websocket::error::upgrade_declined) {
      throw HandshakeRefused(response.result_int(), std::string(response.body()));
    }
    if (error) throw ConnectionEnded(0, error.message());
  }

  void write(std::string_view bytes, bool binary) {
    socket_.binary(binary);
    const error_code error = finish("sending", [&](auto done) {
      socket_.async_write(asio::buffer(bytes.data(), bytes.size()),
                          [done](error_code written, std::size_t) mutable { done(written); });
    });
    if (error) throw ended(error);
  }

  std::optional<std::string> read(std::chrono::milliseconds timeout) {
    if (!reading_) {
      reading_ = true;
      read_ = false;
      buffer_.clear();
      socket_.async_read(buffer_, [this](error_code error, std::size_t) {
        readError_ = error;
        read_ = true;
      });
    }
    // A read that is not done in time stays under way for the next call.
    if (!runUntil(read_, timeout)) return std::nullopt;
    reading_ = false;
    if (readError_) throw ended(readError_);
    return beast::buffers_to_string(buffer_.data());
  }

  void close() {
    const error_code error =
        finish("closing", [&](auto done) { socket_.async_close(websocket::close_code::normal, std::move(done)); });
    if (error && error != asio::error::operation_aborted) throw ended(error);
  }

  void vanish() {
    tcp::socket& socket = socket_.next_layer();
    error_code ignored;
    socket.set_option(asio::socket_base::linger(true, 0), ignored);
    socket.close(ignored);
  }

 private:
  // Starts an operation and runs it to its end.
  template <class Start>
  error_code finish(const std::string& what, Start&& start) {
    bool finished = false;
    error_code result;
    start([&](error_code error) {
      result = error;
      finished = true;
    });
    if (!runUntil(finished, kPatience)) {
      vanish();
      // The operation refers to locals, so it has to end before they do.
      runUntil(finished, kPatience);
      throw TimedOut(what + " took too long");
    }
    return result;
  }

  bool runUntil(const bool& finished, std::chrono::milliseconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    io_.restart();
    while (!finished && std::chrono::steady_clock::now() < deadline) io_.run_one_until(deadline);
    return finished;
  }

  ConnectionEnded ended(const error_code& error) const {
    const websocket::close_reason& reason = socket_.reason();
    if (error == websocket::error::closed)
      return {reason.code, std::string(reason.reason.data(), reason.reason.size())};
    return {0, error.message()};
  }

  asio::io_context io_{1};
  websocket::stream<tcp::socket> socket_{io_};
  beast::flat_buffer buffer_;
  bool reading_ = false;
  bool read_ = false;
  error_code readError_;
};

TestViewer::TestViewer() : impl_(std::make_unique<Impl>()) {}

TestViewer::TestViewer(const std::string& host, std::uint16_t port, const ConnectOptions& options) : TestViewer() {
  connect(host, port, options);
}

TestViewer::~TestViewer() = default;
TestViewer::TestViewer(TestViewer&&) noexcept = default;
TestViewer& TestViewer::operator=(TestViewer&&) noexcept = default;

void TestViewer::connect(const std::string& host, std::uint16_t port, const ConnectOptions& options) {
  impl_ = std::make_unique<Impl>();
  lastSequence_ = 0;
  impl_->connect(host, port, options);
}

std::uint64_t TestViewer::send(v1::ClientMessage message) {
  if (message.sequence() == 0) message.set_sequence(lastSequence_ + 1);
  lastSequence_ = std::max(lastSequence_, message.sequence());
  sendBinary(message.SerializeAsString());
  return message.sequence();
}

void TestViewer::sendBinary(std::string_view bytes) { impl_->write(bytes, true); }

void TestViewer::sendText(std::string_view text) { impl_->write(text, false); }

std::optional<v1::ServerMessage> TestViewer::tryReceive(std::chrono::milliseconds timeout) {
  const std::optional<std::string> bytes = impl_->read(timeout);
  if (!bytes) return std::nullopt;
  v1::ServerMessage message;
  if (!message.ParseFromString(*bytes)) throw std::runtime_error("the server sent no sluice.v1.ServerMessage");
  return message;
}

v1::ServerMessage TestViewer::receive() {
  std::optional<v1::ServerMessage> message = tryReceive(kPatience);
  if (!message) throw TimedOut("no message came");
  return *std::move(message);
}

v1::ServerMessage TestViewer::receive(v1::ServerMessage::MessageCase kind) {
  for (;;) {
    v1::ServerMessage message = receive();
    if (message.message_case() == kind) return message;
  }
}

v1::ServerMessage TestViewer::receiveReply(std::uint64_t sequence) {
  for (;;) {
    v1::ServerMessage message = receive();
    if (message.in_reply_to() == sequence) return message;
  }
}

v1::Welcome TestViewer::helloAs(v1::Role role, const std::string& token) {
  v1::ClientMessage message;
  message.mutable_hello()->set_role(role);
  message.mutable_hello()->set_token(token);
  return receiveReply(send(message)).welcome();
}

v1::Welcome TestViewer::hello(const std::string& client) {
  v1::ClientMessage message;
  message.mutable_hello()->set_client(client);
  const v1::ServerMessage answer = receiveReply(send(std::move(message)));
  if (!answer.has_welcome()) throw std::runtime_error("no Welcome: " + answer.ShortDebugString());
  return answer.welcome();
}

std::uint64_t TestViewer::setView(std::uint32_t width, std::uint32_t height, const std::vector<v1::Codec>& codecs,
                                  std::uint32_t quality, double maxRate) {
  v1::ClientMessage message;
  v1::SetView& view = *message.mutable_set_view();
  view.set_width(width);
  view.set_height(height);
  for (const v1::Codec codec : codecs) view.add_codecs(codec);
  view.set_quality(quality);
  view.set_max_rate(maxRate);
  return send(std::move(message));
}

std::uint64_t TestViewer::setCamera(const v1::Camera& camera) {
  v1::ClientMessage message;
  *message.mutable_set_camera()->mutable_camera() = camera;
  return send(std::move(message));
}

void TestViewer::acknowledge(std::uint64_t frameId) {
  v1::ClientMessage message;
  message.mutable_frame_ack()->set_frame_id(frameId);
  send(std::move(message));
}

v1::Frame TestViewer::nextFrame(bool acknowledged) {
  for (;;) {
    v1::ServerMessage message = receive(v1::ServerMessage::kFrame);
    if (message.frame().snapshot()) continue;
    if (acknowledged) acknowledge(message.frame().frame_id());
    return std::move(*message.mutable_frame());
  }
}

v1::Frame TestViewer::frameReflecting(std::uint64_t sequence) {
  for (;;) {
    v1::Frame frame = nextFrame();
    if (frame.reflects_sequence() >= sequence) return frame;
  }
}

ConnectionEnded TestViewer::waitForEnd() {
  try {
    for (;;) receive();
  } catch (const ConnectionEnded& end) {
    return end;
  }
}

void TestViewer::close() { impl_->close(); }

void TestViewer::vanish() { impl_->vanish(); }

}  // namespace sluice::test
