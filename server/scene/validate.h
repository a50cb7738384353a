#pragma once

#include <optional>
#include <string>

#include <google/protobuf/message.h>

#include "field_path.h"

namespace sluice::scene {

/// A value that its annotation refuses.
struct Problem {
  FieldPath path;
  std::string text;
};

/// The first one, in the order of the schema. Fields that are not set are judged only where they are required.
std::optional<Problem> findProblem(const google::protobuf::Message& message);

}  // namespace sluice::scene
