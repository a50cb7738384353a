#pragma once

#include <ostream>

#include <nlohmann/json.hpp>

namespace nlohmann {

// GoogleTest takes a JSON value for a container of JSON values and would print a number, which holds itself, for ever.

inline void PrintTo(const json& value, std::ostream* out) { *out << value.dump(); }
inline void PrintTo(const ordered_json& value, std::ostream* out) { *out << value.dump(); }

}  // namespace nlohmann
