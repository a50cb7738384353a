#include "names.h"

#include <algorithm>
#include <numeric>

namespace sluice::scene {

namespace {

/// Levenshtein's distance: insertions, deletions and replacements of one letter that lead from a to b.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({replaced, row[j] + 1, row[j + 1] + 1}));
    }
  }
  return row.back();
}

}  // namespace

std::string suggestNames(std::string_view name, const std::vector<std::string>& candidates) {
  // Names from the network may be long; no name of ours is.
  constexpr std::size_t kLongestName = 64;
  std::vector<std::string> near;
  if (name.size() <= kLongestName) {
    const std::size_t tolerance = std::max<std::size_t>(1, name.size() / 3);
    for (const std::string& candidate : candidates) {
      const bool contains = name.size() >= 3 && candidate.find(name) != std::string::npos;
      if (contains || editDistance(name, candidate) <= tolerance) near.push_back(candidate);
    }
  }
  if (!near.empty()) return "did you mean " + joinNames(near, " or ") + "?";
  if (candidates.empty()) return "there is none";
  return "there is " + joinNames(candidates);
}

std::string joinNames(const std::vector<std::string>& names, std::string_view separator) {
  std::string text;
  for (const std::string& name : names) {
    if (!text.empty()) text += separator;
    text += name;
  }
  return text;
}

std::vector<std::string> fieldNames(const google::protobuf::Descriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

std::string inQuotes(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  constexpr std::string_view kHexDigits = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += {'\\', 'x', kHexDigits[byte >> 4U], kHexDigits[byte & 15U]};
    } else {
      result += c;
    }
  }
  return result + (text.size() > kLongest ? "…\"" : "\"");
}

}  // namespace sluice::scene
