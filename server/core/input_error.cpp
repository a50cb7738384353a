#include "sluice/core/input_error.h"

#include <utility>

namespace sluice::core {

namespace {

std::string describe(const std::string& where, const std::string& fieldPath, const std::string& problem) {
  std::string text;
  for (const std::string* part : {&where, &fieldPath}) {
    if (!part->empty()) text += *part + ": ";
  }
  return text + problem;
}

}  // namespace

InputError::InputError(std::string where, std::string fieldPath, std::string problem)
    : std::runtime_error(describe(where, fieldPath, problem)),
      where_(std::move(where)),
      fieldPath_(std::move(fieldPath)),
      problem_(std::move(problem)) {}

}  // namespace sluice::core
