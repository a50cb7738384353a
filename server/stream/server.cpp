#include "sluice/stream/server.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "listener.h"
#include "server_context.h"
#include "session.h"
#include "wire.h"

namespace sluice::stream {

namespace {

// The kind of message of which a viewer needs only the newest.
std::optional<Outbox::Latest> latestKind(const v1::ServerMessage& message) {
  if (message.in_reply_to() != 0) return std::nullopt;
  switch (message.message_case()) {
    case v1::ServerMessage::kStats:
      return Outbox::Latest::Stats;
    case v1::ServerMessage::kPlanChanged:
      return Outbox::Latest::Plan;
    default:
      return std::nullopt;
  }
}

SendResult sendTo(Session& session, const v1::ServerMessage& message, WireMessage wire) {
  if (const auto kind = latestKind(message)) return session.sendLatest(*kind, std::move(wire));
  return session.sendReply(std::move(wire), message.in_reply_to());
}

}  // namespace

class Server::Impl {
 public:
  Impl(const ServerOptions& options, Backend& backend) : context(options, backend), listener(io, context) {}

  ServerContext context;  // Before `io`: sessions that `io` still holds at the end refer to it.
  asio::io_context io{1};
  Listener listener;
};

Server::Server(const ServerOptions& options, Backend& backend) : impl_(std::make_unique<Impl>(options, backend)) {}

Server::~Server() = default;

std::uint16_t Server::port() const { return impl_->listener.port(); }

void Server::run() {
  impl_->listener.start();
  impl_->io.run();
}

void Server::stop(const std::string& reason) {
  asio::post(impl_->io, [this, reason] {
    impl_->listener.stop();
    for (const auto& session : impl_->context.registry.all()) session->close({CloseCode::GoingAway, reason});
  });
}

SendResult Server::sendFrame(const core::EncodedFrame& frame, const core::Delivery& delivery) {
  const auto session = impl_->context.registry.find(delivery.viewer);
  if (!session || !session->joined()) return SendResult::Gone;
  WireMessage wire = toWire(frame, delivery);
  if (delivery.inReplyTo != 0) return session->sendReply(std::move(wire), delivery.inReplyTo);
  return session->sendFrame(delivery.frameId, std::move(wire));
}

SendResult Server::send(core::ViewerId viewer, v1::ServerMessage message) {
  const auto session = impl_->context.registry.find(viewer);
  if (!session || !session->joined()) return SendResult::Gone;
  return sendTo(*session, message, toWire(message));
}

void Server::broadcast(v1::ServerMessage message) {
  const WireMessage wire = toWire(message);
  for (const auto& session : impl_->context.registry.all()) {
    if (session->joined()) sendTo(*session, message, wire);
  }
}

}  // namespace sluice::stream
