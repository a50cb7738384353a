#pragma once

#include <string>

#include <boost/asio/ssl/context.hpp>

#include "sluice/client/connection.h"

namespace sluice::client {

/// TLS 1.2 or later that trusts the certificates of `access.caFile`, or the system's. Throws UsageError for a file that
/// holds none.
boost::asio::ssl::context makeTlsContext(const Access& access);

/// Has the handshake name `host` to the server (SNI, RFC 6066) and, with `verify`, demand a trusted certificate in that
/// name (RFC 6125).
void expectHost(SSL* connection, const std::string& host, bool verify);

/// Why the server's certificate was not taken; empty where it was.
std::string certificateProblem(const SSL* connection);

}  // namespace sluice::client
