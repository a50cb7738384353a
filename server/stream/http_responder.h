#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstddef>
#include <optional>
#include <string>

#include "server_context.h"

namespace sluice::stream {

namespace beast = boost::beast;
using HttpRequest = beast::http::request<beast::http::string_body>;
using HttpResponse = beast::http::response<beast::http::string_body>;

// What HTTP requests are answered: functions of the request and the state, without I/O but for the page's files.

/// The answer to a request that is no WebSocket handshake.
HttpResponse respond(const HttpRequest& request, const ServerContext& context);

/// A plain-text answer of one line.
HttpResponse plainResponse(const HttpRequest& request, beast::http::status status, const std::string& line);

/// The token that a request carries in its Authorization header, or empty.
std::string shownToken(const HttpRequest& request);

/// Why a WebSocket handshake from `address` is refused; none: it may go on.
std::optional<HttpResponse> refuseHandshake(const HttpRequest& request, const std::string& address,
                                            const ServerContext& context);

}  // namespace sluice::stream
