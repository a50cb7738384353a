#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "registry.h"
#include "sluice/stream/server.h"
#include "static_files.h"
#include "tls.h"

namespace sluice::stream {

/// The subprotocol that a viewer must offer in its handshake.
inline constexpr const char* kSubprotocol = "sluice.v1";

/// Where the WebSocket is; everything else is HTTP.
inline constexpr const char* kStreamTarget = "/stream";

/// What has happened since the server started.
struct Counters {
  std::atomic<std::uint64_t> connections = 0;
  std::atomic<std::uint64_t> refusedHandshakes = 0;
  std::atomic<std::uint64_t> messagesReceived = 0;
  std::atomic<std::uint64_t> bytesSent = 0;
};

/// What every connection of one server shares. Outlives them all.
struct ServerContext {
  /// Throws core::InputError where the files of TLS are not what they should be.
  ServerContext(const ServerOptions& serverOptions, Backend& serverBackend)
      : options(serverOptions), backend(serverBackend), files(serverOptions.webRoot) {
    if (options.tls) tls.emplace(makeTlsContext(options.tls->certificate, options.tls->key));
  }

  void log(const LogEvent& event) const {
    if (options.log) options.log(event);
  }

  const ServerOptions options;
  Backend& backend;
  Registry registry;
  const StaticFiles files;
  std::optional<boost::asio::ssl::context> tls;
  Counters counters;
};

}  // namespace sluice::stream
