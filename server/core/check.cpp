#include "sluice/core/check.h"

#include <cstdio>
#include <cstdlib>

namespace sluice::core {

void checkFailed(std::string_view file, int line, std::string_view condition, std::string_view detail) {
  std::fprintf(stderr, "%.*s:%d: check failed: %.*s%s%.*s\n", static_cast<int>(file.size()), file.data(), line,
               static_cast<int>(condition.size()), condition.data(), detail.empty() ? "" : ": ",
               static_cast<int>(detail.size()), detail.data());
  std::abort();
}

}  // namespace sluice::core
