#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sluice::client {

/// One step along a field path: a field's name, and the index of an element where the field is a list.
struct PathStep {
  std::string name;
  std::optional<std::uint32_t> index;

  bool operator==(const PathStep&) const = default;
};

/// The steps of a path such as "simulation.fluids[0].viscosity":
///   path = step *("." step)    step = name ["[" digits "]"]    name = lower-case letters, digits and "_"
/// Throws UsageError for anything else.
std::vector<PathStep> parseFieldPath(std::string_view path);

}  // namespace sluice::client
