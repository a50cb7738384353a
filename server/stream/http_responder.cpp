#include "http_responder.h"

#include <algorithm>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <cctype>
#include <fstream>
#include <iterator>
#include <utility>

#include "server_context.h"

namespace sluice::stream {

namespace http = beast::http;

namespace {

// What keeps other sites from using this one behind its user's back.
void guard(HttpResponse& answer) {
  // Without it a browser may guess another type from the bytes.
  answer.set("X-Content-Type-Options", "nosniff");
  answer.set("X-Frame-Options", "DENY");
  answer.set("Referrer-Policy", "no-referrer");
  answer.set("Cross-Origin-Opener-Policy", "same-origin");
  answer.set("Cross-Origin-Resource-Policy", "same-origin");
}

// A host as browsers send it; anything else has no place in another header.
bool isPlainHost(beast::string_view host) {
  return !host.empty() && std::all_of(host.begin(), host.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '-' || c == ':' || c == '[' || c == ']';
  });
}

// The page runs its own scripts alone, and talks to this server alone. 'self' does not cover WebSockets in every
// browser, so they are named.
std::string contentPolicy(const HttpRequest& request) {
  const beast::string_view host = request[http::field::host];
  std::string sockets;
  if (isPlainHost(host)) sockets = " ws://" + std::string(host) + " wss://" + std::string(host);
  return "default-src 'self'; connect-src 'self'" + sockets +
         "; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; worker-src 'self' blob:; "
         "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

HttpResponse response(const HttpRequest& request, http::status status, std::string_view contentType, std::string body) {
  HttpResponse answer(status, request.version());
  answer.set(http::field::content_type, beast::string_view(contentType.data(), contentType.size()));
  guard(answer);
  answer.keep_alive(request.keep_alive());
  answer.content_length(body.size());
  // The head of a response to HEAD tells the length of the body that GET would give.
  if (request.method() != http::verb::head) answer.body() = std::move(body);
  return answer;
}

HttpResponse health(const HttpRequest& request, std::size_t viewers) {
  HttpResponse answer = response(
      request, http::status::ok, "application/json",
      R"({"status": "ok", "viewers": )" + std::to_string(viewers) + R"(, "version": ")" SLUICE_VERSION "\"}\n");
  answer.set(http::field::cache_control, "no-store");
  return answer;
}

// Counts can tell who looks at what, so they need the token where there is one.
HttpResponse metrics(const HttpRequest& request, const ServerContext& context) {
  if (!context.options.access.roleFor(shownToken(request), v1::SPECTATOR)) {
    HttpResponse answer = plainResponse(request, http::status::unauthorized, "the token is missing or wrong");
    answer.set(http::field::www_authenticate, "Bearer");
    return answer;
  }
  const Counters& counters = context.counters;
  const auto count = [](const std::atomic<std::uint64_t>& counter) {
    return static_cast<double>(counter.load(std::memory_order_relaxed));
  };
  MetricsText text;
  text.gauge("sluice_viewers", "Viewers that are connected.", static_cast<double>(context.registry.size()));
  text.counter("sluice_connections_total", "TCP connections taken.", count(counters.connections));
  text.counter("sluice_refused_handshakes_total", "WebSocket handshakes refused.", count(counters.refusedHandshakes));
  text.counter("sluice_messages_received_total", "Messages of viewers.", count(counters.messagesReceived));
  text.counter("sluice_bytes_sent_total", "Bytes of messages sent to viewers.", count(counters.bytesSent));
  context.backend.metrics(text);
  HttpResponse answer = response(request, http::status::ok, "text/plain; version=0.0.4; charset=utf-8", text.text());
  answer.set(http::field::cache_control, "no-store");
  return answer;
}

bool matches(beast::string_view ifNoneMatch, const std::string& etag) {
  return ifNoneMatch == "*" || ifNoneMatch.find(beast::string_view(etag)) != beast::string_view::npos;
}

HttpResponse serveFile(const HttpRequest& request, const StaticFile& file) {
  HttpResponse answer;
  if (matches(request[http::field::if_none_match], file.etag)) {
    answer = HttpResponse(http::status::not_modified, request.version());
    answer.keep_alive(request.keep_alive());
  } else {
    std::ifstream stream(file.path, std::ios::binary);
    std::string body(std::istreambuf_iterator<char>(stream), {});
    if (!stream) return plainResponse(request, http::status::not_found, "no such page");
    answer = response(request, http::status::ok, file.contentType, std::move(body));
    if (file.contentType.starts_with("text/html")) answer.set("Content-Security-Policy", contentPolicy(request));
  }
  answer.set(http::field::etag, file.etag);
  answer.set(http::field::cache_control, file.immutable ? "public, max-age=31536000, immutable" : "no-cache");
  return answer;
}

bool offersSubprotocol(const HttpRequest& request) {
  const http::token_list offered(request[http::field::sec_websocket_protocol]);
  return std::any_of(offered.begin(), offered.end(), [](beast::string_view name) { return name == kSubprotocol; });
}

// Browsers send Origin, and a page of another site must not drive this server behind its user's back (cross-site
// WebSocket hijacking); other programs send none.
bool comesFromAllowedPage(const HttpRequest& request, const std::vector<std::string>& allowedOrigins) {
  const beast::string_view origin = request[http::field::origin];
  if (origin.empty()) return true;
  const beast::string_view host = request[http::field::host];
  for (const beast::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme) && beast::iequals(origin.substr(scheme.size()), host)) return true;
  }
  return std::any_of(allowedOrigins.begin(), allowedOrigins.end(),
                     [&](const std::string& allowed) { return beast::iequals(origin, allowed); });
}

HttpResponse tooMany(const HttpRequest& request, const std::string& line) {
  HttpResponse answer = plainResponse(request, http::status::service_unavailable, line);
  answer.set(http::field::retry_after, "5");
  return answer;
}

}  // namespace

HttpResponse plainResponse(const HttpRequest& request, http::status status, const std::string& line) {
  return response(request, status, "text/plain; charset=utf-8", line + "\n");
}

HttpResponse respond(const HttpRequest& request, const ServerContext& context) {
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    HttpResponse answer = plainResponse(request, http::status::method_not_allowed, "only GET and HEAD are known here");
    answer.set(http::field::allow, "GET, HEAD");
    return answer;
  }
  const std::string_view target(request.target().data(), request.target().size());
  const auto path = decodedPath(target);
  if (!path)
    return plainResponse(request, http::status::bad_request, "the path is not percent-encoded as it should be");
  if (*path == "/healthz") return health(request, context.registry.size());
  if (*path == "/metrics") return metrics(request, context);
  if (*path == kStreamTarget) {
    HttpResponse answer = plainResponse(request, http::status::upgrade_required, "this is a WebSocket");
    answer.set(http::field::upgrade, "websocket");
    return answer;
  }
  if (const auto file = context.files.find(target)) return serveFile(request, *file);
  return plainResponse(request, http::status::not_found, "no such page");
}

std::string shownToken(const HttpRequest& request) {
  const beast::string_view header = request[http::field::authorization];
  return std::string(bearerToken({header.data(), header.size()}));
}

std::optional<HttpResponse> refuseHandshake(const HttpRequest& request, const std::string& address,
                                            const ServerContext& context) {
  const std::string_view target(request.target().data(), request.target().size());
  if (decodedPath(target) != kStreamTarget) {
    return plainResponse(request, http::status::not_found, "the WebSocket is at /stream");
  }
  if (!offersSubprotocol(request)) {
    return plainResponse(request, http::status::bad_request, "the subprotocol must be sluice.v1");
  }
  if (!comesFromAllowedPage(request, context.options.allowedOrigins)) {
    return plainResponse(request, http::status::forbidden, "pages of another origin may not connect");
  }
  // A page cannot set headers, so a handshake without a token may still show one in its Hello.
  const std::string token = shownToken(request);
  if (!token.empty() && !context.options.access.roleFor(token, v1::ROLE_UNSPECIFIED)) {
    HttpResponse answer = plainResponse(request, http::status::unauthorized, "the token is wrong");
    answer.set(http::field::www_authenticate, "Bearer");
    return answer;
  }
  if (context.registry.size() >= static_cast<std::size_t>(context.options.maxViewers)) {
    return tooMany(request, "all " + std::to_string(context.options.maxViewers) + " places are taken");
  }
  if (context.registry.sizeFrom(address) >= static_cast<std::size_t>(context.options.maxViewersPerAddress)) {
    return tooMany(request, "this address has " + std::to_string(context.options.maxViewersPerAddress) +
                                " viewers already, as many as it may");
  }
  return std::nullopt;
}

}  // namespace sluice::stream
