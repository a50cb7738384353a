#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "sluice/core/plan.h"
#include "sluice/core/stage_times.h"

namespace sluice::app {

using Json = nlohmann::ordered_json;

/// {"stage": milliseconds, …}
Json toJson(const core::StageTimes& times);

/// {"stages": [...], "buffers": [...], "left_out": [...]}
Json toJson(const core::Plan& plan);

/// [{"name": …, "reason": …}, …]
Json toJson(const std::vector<core::LeftOut>& leftOut);

}  // namespace sluice::app
