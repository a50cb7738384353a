#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace sluice::test {

/// A blocking TCP connection to 127.0.0.1 that speaks no protocol: for requests that no decent client would send.
class RawSocket {
 public:
  explicit RawSocket(std::uint16_t port);
  ~RawSocket();
  RawSocket(const RawSocket&) = delete;
  RawSocket& operator=(const RawSocket&) = delete;

  /// False where the peer has closed.
  bool write(std::string_view bytes);

  /// Reads until `end` has been read or the peer closes, with a patience of kPatience.
  std::string readUntil(std::string_view end);
  std::string readAll();

  /// No more bytes follow; reading goes on.
  void finishWriting();

  /// Closes with a reset.
  void vanish();

 private:
  int descriptor_ = -1;
};

/// Sends a request and returns all that comes back until the server closes: head, blank line, body.
std::string httpExchange(std::uint16_t port, std::string_view request);

/// "GET <target> HTTP/1.1" with Connection: close, plus any further header lines (each ending in CR LF).
std::string httpGet(std::uint16_t port, const std::string& target, const std::string& headers = {});

}  // namespace sluice::test
