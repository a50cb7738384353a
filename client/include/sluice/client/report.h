#pragma once

#include <string>

#include <google/protobuf/repeated_ptr_field.h>

#include "sluice/client/json.h"
#include "sluice/v1/session.pb.h"

namespace sluice::client {

/// Stage names with their milliseconds.
Json stagesJson(const google::protobuf::RepeatedPtrField<v1::StageTime>& stages);

/// [x, y, z].
Json vectorJson(const v1::Vec3& vector);

/// Every field of Stats under its own name.
Json statsJson(const v1::Stats& stats);

/// "playing", "paused", or why the simulation stopped by itself.
std::string stateText(const v1::Stats& stats);

/// Several lines, each ended: the state at a glance and the stages of a step.
std::string statsTable(const v1::Stats& stats);

/// The heading of statsLine.
std::string statsLineHeading();

/// One line without its end: the same figures for logs.
std::string statsLine(const v1::Stats& stats);

/// With at most so many significant digits.
std::string formatRounded(double value, int digits = 4);

}  // namespace sluice::client
