#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "static_files.h"

namespace sluice::stream {

namespace beast = boost::beast;
using HttpRequest = beast::http::request<beast::http::string_body>;
using HttpResponse = beast::http::response<beast::http::string_body>;

// What HTTP requests are answered: functions of the request and the state, without I/O but for the page's files.

/// The answer to a request that is no WebSocket handshake.
HttpResponse respond(const HttpRequest& request, const StaticFiles& files, std::size_t viewers);

/// A plain-text answer of one line.
HttpResponse plainResponse(const HttpRequest& request, beast::http::status status, const std::string& line);

struct Admission {
  std::size_t viewers = 0;
  std::size_t maxViewers = 0;
  /// Origins of pages that may connect, beside those of this server's own.
  std::vector<std::string> allowedOrigins;
};

/// Why a WebSocket handshake is refused; none: it may go on.
std::optional<HttpResponse> refuseHandshake(const HttpRequest& request, const Admission& admission);

}  // namespace sluice::stream
