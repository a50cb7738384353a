#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <google/protobuf/descriptor.h>

namespace sluice::scene {

/// "did you mean radius?" where a candidate is within a few letters of `name`, else "there is a, b, c".
std::string suggestNames(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b, c".
std::string joinNames(const std::vector<std::string>& names, std::string_view separator = ", ");

std::vector<std::string> fieldNames(const google::protobuf::Descriptor& type);

/// In quotation marks, with line breaks and other control characters escaped: a message stays one line.
std::string inQuotes(std::string_view text);

}  // namespace sluice::scene
