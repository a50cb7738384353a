#include "sluice/client/requests.h"

#include <chrono>
#include <sstream>
#include <utility>

#include "sluice/client/failure.h"

namespace sluice::client {

namespace {

bool isAnswer(const v1::ServerMessage& message) {
  return message.has_done() || message.has_pong() || message.has_picked() ||
         (message.has_frame() && message.frame().snapshot());
}

}  // namespace

std::string describe(const v1::Error& error) {
  return error.field_path().empty() ? error.message() : error.field_path() + ": " + error.message();
}

v1::ServerMessage request(Connection& connection, v1::ClientMessage message,
                          const std::function<void(const v1::ServerMessage&)>& other) {
  return request(connection, std::move(message), Connection::Clock::now() + connection.timeout(), other);
}

v1::ServerMessage request(Connection& connection, v1::ClientMessage message, Connection::Clock::time_point deadline,
                          const std::function<void(const v1::ServerMessage&)>& other) {
  const std::uint64_t sequence = connection.send(std::move(message));
  while (std::optional<v1::ServerMessage> reply = connection.receive(deadline)) {
    if (reply->in_reply_to() == sequence) {
      if (reply->has_error()) throw RequestError(describe(reply->error()));
      if (isAnswer(*reply)) return std::move(*reply);
    }
    if (other) other(*reply);
  }
  std::ostringstream problem;
  problem << "the server gave no answer within " << std::chrono::duration<double>(connection.timeout()).count() << " s";
  throw RequestError(problem.str());
}

v1::Stats currentStats(Connection& connection) {
  v1::ClientMessage fence;
  fence.mutable_ping();
  request(connection, std::move(fence));
  return connection.latestStats().value_or(v1::Stats());
}

}  // namespace sluice::client
