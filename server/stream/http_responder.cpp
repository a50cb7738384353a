#include "http_responder.h"

#include <algorithm>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <fstream>
#include <iterator>
#include <utility>

#include "server_context.h"

namespace sluice::stream {

namespace http = beast::http;

namespace {

HttpResponse response(const HttpRequest& request, http::status status, std::string_view contentType, std::string body) {
  HttpResponse answer(status, request.version());
  answer.set(http::field::content_type, beast::string_view(contentType.data(), contentType.size()));
  // Without it a browser may guess another type from the bytes.
  answer.set("X-Content-Type-Options", "nosniff");
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

}  // namespace

HttpResponse plainResponse(const HttpRequest& request, http::status status, const std::string& line) {
  return response(request, status, "text/plain; charset=utf-8", line + "\n");
}

HttpResponse respond(const HttpRequest& request, const StaticFiles& files, std::size_t viewers) {
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    HttpResponse answer = plainResponse(request, http::status::method_not_allowed, "only GET and HEAD are known here");
    answer.set(http::field::allow, "GET, HEAD");
    return answer;
  }
  const std::string_view target(request.target().data(), request.target().size());
  const auto path = decodedPath(target);
  if (!path)
    return plainResponse(request, http::status::bad_request, "the path is not percent-encoded as it should be");
  if (*path == "/healthz") return health(request, viewers);
  if (*path == kStreamTarget) {
    HttpResponse answer = plainResponse(request, http::status::upgrade_required, "this is a WebSocket");
    answer.set(http::field::upgrade, "websocket");
    return answer;
  }
  if (const auto file = files.find(target)) return serveFile(request, *file);
  return plainResponse(request, http::status::not_found, "no such page");
}

std::optional<HttpResponse> refuseHandshake(const HttpRequest& request, const Admission& admission) {
  const std::string_view target(request.target().data(), request.target().size());
  if (decodedPath(target) != kStreamTarget) {
    return plainResponse(request, http::status::not_found, "the WebSocket is at /stream");
  }
  if (!offersSubprotocol(request)) {
    return plainResponse(request, http::status::bad_request, "the subprotocol must be sluice.v1");
  }
  if (!comesFromAllowedPage(request, admission.allowedOrigins)) {
    return plainResponse(request, http::status::forbidden, "pages of another origin may not connect");
  }
  if (admission.viewers >= admission.maxViewers) {
    HttpResponse answer = plainResponse(request, http::status::service_unavailable,
                                        "all " + std::to_string(admission.maxViewers) + " places are taken");
    answer.set(http::field::retry_after, "5");
    return answer;
  }
  return std::nullopt;
}

}  // namespace sluice::stream
