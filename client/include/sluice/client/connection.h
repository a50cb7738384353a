#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sluice/client/server_url.h"
#include "sluice/v1/session.pb.h"

namespace sluice::client {

/// How a server is entered, and how far it is trusted.
struct Access {
  /// Shown in the handshake (Authorization: Bearer), unless empty; never part of a message.
  std::string token;
  /// The role wanted; unspecified takes the highest that the token allows.
  v1::Role role = v1::ROLE_UNSPECIFIED;
  /// File of certificates in PEM that vouch for a wss:// server, in place of the system's; empty: the system's.
  std::string caFile;
  /// Whether the certificate of a wss:// server has to be vouched for, and to name its host.
  bool verify = true;
};

/// A viewer's connection to a server: opened, welcomed, closed again by the destructor. Calls block, but never beyond
/// their time; the socket is served only inside them. For one thread at a time.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  /// Connects and says Hello. `timeout` bounds this, and each later send. Throws ConnectionError; UsageError for a file
  /// of certificates that cannot be used.
  Connection(const ServerUrl& url, Clock::duration timeout, const Access& access = {});
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const ServerUrl& url() const;
  const v1::Welcome& welcome() const;
  Clock::duration timeout() const;

  /// From here on takes no more than so many bytes a second, > 0, as on a link that carries no more: a message is there
  /// once its bytes would have come.
  void limitRate(double bytesPerSecond);

  /// The newest Stats that `receive` has given out; none before the first.
  const std::optional<v1::Stats>& latestStats() const;

  /// Numbers the message, sends it, and returns its number. Throws RequestError for a message larger than the server
  /// takes, ConnectionError where it cannot be sent.
  std::uint64_t send(v1::ClientMessage message);

  /// The next message from the server; none when `deadline` passes before one has come. Throws ConnectionError when
  /// the connection has ended.
  std::optional<v1::ServerMessage> receive(Clock::time_point deadline);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sluice::client
