#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sluice::client {

/// Where a server's stream is.
struct ServerUrl {
  std::string host;
  std::uint16_t port = 8080;
  std::string path = "/stream";
  bool tls = false;

  /// host:port as an HTTP Host header has it; an IPv6 address in brackets.
  std::string authority() const;
  std::string text() const;

  bool operator==(const ServerUrl&) const = default;
};

/// Takes ws://host[:port][/path], or wss:// for TLS; the scheme may be left out, or be the http:// or https:// of the
/// server's page. The port is the server's 8080 unless it is given; a path that is absent or "/" means /stream. Throws
/// UsageError.
ServerUrl parseServerUrl(std::string_view text);

}  // namespace sluice::client
