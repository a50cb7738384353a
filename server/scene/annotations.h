#pragma once

#include <string>

#include <google/protobuf/descriptor.h>

#include "sluice/v1/options.pb.h"

namespace sluice::scene {

using google::protobuf::FieldDescriptor;

const v1::FieldInfo& infoOf(const FieldDescriptor& field);

bool isMessage(const FieldDescriptor& field);

/// A field of type Vec3, whose annotation holds for each of its components.
bool isVector(const FieldDescriptor& field);

/// A field of one of protobuf's number types; not bool, not an enum.
bool isNumber(const FieldDescriptor& field);

bool isFloatingPoint(const FieldDescriptor& field);

/// The shortest text that reads back as the same number, with plain exponents: "0.05", "1e5", "1e-6".
std::string formatNumber(double value);

/// What an annotation allows a number to be, for the end of a message: "[0, 100] m²/s", "at least 1 m", "1, 2 or 4".
/// Empty where everything is allowed.
std::string allowedText(const v1::FieldInfo& info);

/// What an annotation says of one number; empty when it is allowed, else "-1 is outside [0, 100] m²/s".
std::string numberProblem(double value, const v1::FieldInfo& info);

}  // namespace sluice::scene
