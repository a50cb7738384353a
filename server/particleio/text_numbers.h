#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace sluice::particleio {

/// The whole text as a number, in the C locale; "nan" and "inf" are numbers here, to be refused with their particle.
template <class Number>
std::optional<Number> parseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

/// For messages: at most a few dozen characters, and none that could break the line.
inline std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, kLongest)) result += c >= 0x20 && c < 0x7f ? c : '?';
  return result + (text.size() > kLongest ? "…\"" : "\"");
}

}  // namespace sluice::particleio
