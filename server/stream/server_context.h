#pragma once

#include <string>

#include "registry.h"
#include "sluice/stream/server.h"
#include "static_files.h"

namespace sluice::stream {

/// The subprotocol that a viewer must offer in its handshake.
inline constexpr const char* kSubprotocol = "sluice.v1";

/// Where the WebSocket is; everything else is HTTP.
inline constexpr const char* kStreamTarget = "/stream";

/// What every connection of one server shares. Outlives them all.
struct ServerContext {
  ServerContext(const ServerOptions& serverOptions, Backend& serverBackend)
      : options(serverOptions), backend(serverBackend), files(serverOptions.webRoot) {}

  void log(const std::string& line) const {
    if (options.log) options.log(line);
  }

  const ServerOptions options;
  Backend& backend;
  Registry registry;
  const StaticFiles files;
};

}  // namespace sluice::stream
