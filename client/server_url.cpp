#include "sluice/client/server_url.h"

#include <charconv>

#include "sluice/client/failure.h"

namespace sluice::client {

namespace {

[[noreturn]] void fail(std::string_view text, const std::string& problem) {
  throw UsageError("server " + inQuotes(text) + ": " + problem +
                   "; allowed is ws://host[:port][/path], or wss:// for TLS");
}

}  // namespace

std::string ServerUrl::authority() const {
  const bool isIpv6 = host.find(':') != std::string::npos;
  return (isIpv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

std::string ServerUrl::text() const { return (tls ? "wss://" : "ws://") + authority() + path; }

ServerUrl parseServerUrl(std::string_view text) {
  std::string_view rest = text;
  ServerUrl url;
  if (const auto end = rest.find("://"); end != std::string_view::npos) {
    const std::string_view scheme = rest.substr(0, end);
    url.tls = scheme == "wss" || scheme == "https";
    if (!url.tls && scheme != "ws" && scheme != "http") fail(text, "the scheme " + inQuotes(scheme) + " is not known");
    rest.remove_prefix(end + 3);
  }

  if (const auto slash = rest.find('/'); slash != std::string_view::npos) {
    if (rest.size() > slash + 1) url.path = rest.substr(slash);
    rest = rest.substr(0, slash);
  }
  if (url.path.find_first_of(" \t\r\n") != std::string::npos) fail(text, "the path holds white space");

  // The colon of a port stands behind the brackets of an IPv6 address.
  const auto bracket = rest.starts_with('[') ? rest.find(']') : std::string_view::npos;
  if (rest.starts_with('[') && bracket == std::string_view::npos) fail(text, "a bracket is not closed");
  const auto colon = rest.find(':', bracket == std::string_view::npos ? 0 : bracket);
  url.host = bracket == std::string_view::npos ? rest.substr(0, colon) : rest.substr(1, bracket - 1);
  if (url.host.empty() || url.host.find_first_of(" \t\r\n@") != std::string::npos) fail(text, "the host is no host");
  if (bracket != std::string_view::npos && colon != bracket + 1 && rest.size() != bracket + 1) {
    fail(text, "something stands between the address and its port");
  }

  if (colon != std::string_view::npos) {
    const std::string_view digits = rest.substr(colon + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), url.port);
    if (error != std::errc() || end != digits.data() + digits.size() || url.port == 0) {
      fail(text, "the port is no number from 1 to 65535");
    }
  }
  return url;
}

}  // namespace sluice::client
