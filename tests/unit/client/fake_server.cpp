#include "fake_server.h"

#include <mutex>
#include <optional>
#include <thread>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace sluice::client {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::use_awaitable;

class FakeServer::Impl {
 public:
  Impl(React react, std::optional<int> httpStatus)
      : react_(std::move(react)),
        httpStatus_(httpStatus),
        acceptor_(io_, {asio::ip::address_v4::loopback(), 0}),
        port_(acceptor_.local_endpoint().port()) {
    asio::co_spawn(io_, accept(), asio::detached);
    thread_ = std::thread([this] { io_.run(); });
  }

  ~Impl() {
    io_.stop();
    thread_.join();
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::uint16_t port() const { return port_; }

  std::vector<v1::ClientMessage> received() const {
    const std::lock_guard lock(mutex_);
    return received_;
  }

  std::string authorization() const {
    const std::lock_guard lock(mutex_);
    return authorization_;
  }

 private:
  asio::awaitable<void> accept() {
    while (true) {
      asio::ip::tcp::socket socket = co_await acceptor_.async_accept(use_awaitable);
      // A connection that ends, however it does, concerns nobody else.
      asio::co_spawn(io_, serve(std::move(socket)), [](std::exception_ptr) {});
    }
  }

  asio::awaitable<void> serve(asio::ip::tcp::socket connected) {
    beast::tcp_stream tcp(std::move(connected));
    beast::flat_buffer buffer;
    http::request<http::string_body> upgrade;
    co_await http::async_read(tcp, buffer, upgrade, use_awaitable);
    {
      const std::lock_guard lock(mutex_);
      authorization_ = std::string(upgrade[http::field::authorization]);
    }
    if (httpStatus_) {
      http::response<http::string_body> response(static_cast<http::status>(*httpStatus_), upgrade.version());
      response.prepare_payload();
      co_await http::async_write(tcp, response, use_awaitable);
      co_return;
    }
    websocket::stream<beast::tcp_stream> socket(std::move(tcp));
    socket.binary(true);
    co_await socket.async_accept(upgrade, use_awaitable);
    while (true) {
      buffer.clear();
      co_await socket.async_read(buffer, use_awaitable);
      v1::ClientMessage message;
      message.ParseFromArray(buffer.data().data(), static_cast<int>(buffer.size()));
      {
        const std::lock_guard lock(mutex_);
        received_.push_back(message);
      }
      const Reaction reaction = react_(message);
      for (const v1::ServerMessage& answer : reaction.messages) {
        const std::string bytes = answer.SerializeAsString();
        co_await socket.async_write(asio::buffer(bytes), use_awaitable);
      }
      if (!reaction.bytes.empty()) co_await socket.async_write(asio::buffer(reaction.bytes), use_awaitable);
      if (reaction.close) co_await socket.async_close({websocket::close_code::normal, "enough"}, use_awaitable);
    }
  }

  React react_;
  std::optional<int> httpStatus_;
  asio::io_context io_;
  asio::ip::tcp::acceptor acceptor_;
  std::uint16_t port_;
  mutable std::mutex mutex_;
  std::vector<v1::ClientMessage> received_;
  std::string authorization_;
  std::thread thread_;
};

FakeServer::FakeServer(React react) : impl_(std::make_unique<Impl>(std::move(react), std::nullopt)) {}
FakeServer::FakeServer(int httpStatus) : impl_(std::make_unique<Impl>(oblige, httpStatus)) {}
FakeServer::~FakeServer() = default;

ServerUrl FakeServer::url() const { return {"127.0.0.1", impl_->port(), "/stream"}; }
std::vector<v1::ClientMessage> FakeServer::received() const { return impl_->received(); }
std::string FakeServer::authorization() const { return impl_->authorization(); }

v1::ServerMessage replyTo(const v1::ClientMessage& message) {
  v1::ServerMessage reply;
  reply.set_in_reply_to(message.sequence());
  return reply;
}

v1::Welcome someWelcome() {
  v1::Welcome welcome;
  welcome.set_protocol_version(1);
  welcome.set_server_version("0.1.0");
  welcome.set_renderer("a renderer");
  welcome.set_scene_name("dam_break");
  welcome.mutable_scene()->set_title("A dam breaks");
  v1::Camera& camera = *welcome.mutable_scene()->mutable_camera();
  camera.mutable_eye()->set_x(3);
  camera.mutable_target()->set_y(1);
  camera.mutable_up()->set_y(1);
  welcome.add_codecs(v1::JPEG);
  welcome.add_codecs(v1::PNG);
  v1::SceneEntry& entry = *welcome.add_scenes();
  entry.set_name("dam_break");
  entry.set_title("A dam breaks");
  welcome.mutable_limits()->set_max_width(1920);
  welcome.mutable_limits()->set_max_height(1080);
  welcome.mutable_limits()->set_max_message_bytes(1U << 20U);
  return welcome;
}

v1::Stats someStats() {
  v1::Stats stats;
  stats.set_simulation_time(1.5);
  stats.set_steps(300);
  stats.set_particles(1234);
  stats.set_paused(true);
  return stats;
}

Reaction oblige(const v1::ClientMessage& message) {
  Reaction reaction;
  v1::ServerMessage reply = replyTo(message);
  if (message.has_hello()) {
    *reply.mutable_welcome() = someWelcome();
  } else if (message.has_ping()) {
    v1::ServerMessage stats;
    *stats.mutable_stats() = someStats();
    reaction.messages.push_back(stats);
    reply.mutable_pong();
  } else {
    reply.mutable_done();
  }
  reaction.messages.push_back(reply);
  return reaction;
}

}  // namespace sluice::client
