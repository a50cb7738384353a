#pragma once

#include <sstream>
#include <string_view>

namespace sluice::core {

/// Prints the failed condition with its place and ends the process: for what must never happen, not for what a
/// person may give (that is InputError) or the network may do (that is an error code).
[[noreturn]] void checkFailed(std::string_view file, int line, std::string_view condition, std::string_view detail);

namespace detail {

template <class A, class B>
[[noreturn]] void comparisonFailed(std::string_view file, int line, std::string_view condition, const A& a,
                                   const B& b) {
  std::ostringstream text;
  text << a << " against " << b;
  checkFailed(file, line, condition, text.str());
}

}  // namespace detail
}  // namespace sluice::core

#define SLUICE_CHECK(condition)                                        \
  do {                                                                 \
    if (!(condition)) [[unlikely]]                                     \
      ::sluice::core::checkFailed(__FILE__, __LINE__, #condition, ""); \
  } while (false)

#define SLUICE_CHECK_OP_(a, op, b)                                                                       \
  do {                                                                                                   \
    const auto& checkA_ = (a);                                                                           \
    const auto& checkB_ = (b);                                                                           \
    if (!(checkA_ op checkB_)) [[unlikely]]                                                              \
      ::sluice::core::detail::comparisonFailed(__FILE__, __LINE__, #a " " #op " " #b, checkA_, checkB_); \
  } while (false)

#define SLUICE_CHECK_EQ(a, b) SLUICE_CHECK_OP_(a, ==, b)
#define SLUICE_CHECK_LT(a, b) SLUICE_CHECK_OP_(a, <, b)
#define SLUICE_CHECK_LE(a, b) SLUICE_CHECK_OP_(a, <=, b)
