#include "sluice/client/field_path.h"

#include <algorithm>
#include <charconv>

#include "sluice/client/failure.h"

namespace sluice::client {

namespace {

[[noreturn]] void fail(std::string_view path, const std::string& problem) {
  throw UsageError(inQuotes(path) + " is no field path: " + problem +
                   "; a path is written like simulation.fluids[0].viscosity");
}

bool isNameCharacter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; }

PathStep parseStep(std::string_view path, std::string_view text) {
  PathStep step;
  const auto nameEnd = std::find_if_not(text.begin(), text.end(), isNameCharacter);
  step.name.assign(text.begin(), nameEnd);
  if (step.name.empty()) fail(path, "a name is missing");

  std::string_view rest(nameEnd, text.end());
  if (rest.empty()) return step;
  if (!rest.starts_with('[') || !rest.ends_with(']')) {
    fail(path, inQuotes(rest) + " follows " + inQuotes(step.name));
  }
  rest = rest.substr(1, rest.size() - 2);
  std::uint32_t index = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
  if (error != std::errc() || end != rest.data() + rest.size()) {
    fail(path, inQuotes(rest) + " is no index");
  }
  step.index = index;
  return step;
}

}  // namespace

std::vector<PathStep> parseFieldPath(std::string_view path) {
  std::vector<PathStep> steps;
  std::size_t begin = 0;
  while (true) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    steps.push_back(parseStep(path, path.substr(begin, dot - begin)));
    if (dot == path.size()) return steps;
    begin = dot + 1;
  }
}

}  // namespace sluice::client
