#pragma once

#include <string>
#include <string_view>

#include "sluice/evaluate/study.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::evaluate {

/// A scene with all defaults, changed by `text` (protobuf text format), then by what the person assigned. Throws
/// core::InputError.
v1::Scene studyScene(const Options& options, std::string_view text = "column_and_sheet {}");

/// The shipped scene `name`, changed by what the person assigned.
v1::Scene shippedScene(const Options& options, std::string_view name);

}  // namespace sluice::evaluate
