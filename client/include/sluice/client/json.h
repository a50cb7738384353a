#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace sluice::client {

/// Keeps its members in the order in which they are added.
using Json = nlohmann::ordered_json;

/// On one line. What is not finite becomes null, and a byte that is no UTF-8 becomes U+FFFD.
inline std::string toLine(const Json& json) {
  return json.dump(/*indent=*/-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sluice::client
