#pragma once

#include <cstdint>
#include <string>

namespace sluice::stream {

/// Close codes that this server sends, RFC 6455 section 7.4.1.
enum class CloseCode : std::uint16_t {
  GoingAway = 1001,
  UnsupportedData = 1003,
  InvalidPayload = 1007,
  PolicyViolation = 1008,
};

struct CloseReason {
  CloseCode code = CloseCode::GoingAway;
  std::string text;  ///< Cut to what a close frame holds when it is sent.

  bool operator==(const CloseReason&) const = default;
};

}  // namespace sluice::stream
