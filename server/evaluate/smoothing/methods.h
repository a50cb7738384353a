#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <google/protobuf/message.h>

#include "sluice/v1/scene.pb.h"

namespace sluice::evaluate {

// What the schema says of smoothing, by reflection: a method that is added to it gets its rows without any change here.

struct SmoothingMethod {
  std::string name;        ///< The member of the oneof: "curvature_flow".
  bool isDefault = false;  ///< The member that a scene takes when it names none.

  /// Of the pass, as the renderer's stages name it: "curvature flow".
  std::string stage() const;
};

std::vector<SmoothingMethod> smoothingMethods();

/// Makes `method` the chosen one, with its defaults where it was not so already.
void chooseMethod(v1::Smoothing& smoothing, std::string_view method);

/// The message of the chosen method, to change its fields.
google::protobuf::Message& chosenMethod(v1::Smoothing& smoothing);

/// T by default, d².
double defaultSmoothingTime();

/// By what the picture's size may be divided for smoothing, ascending; 1 alone where the schema has no such field.
std::vector<int> smoothingDivisors();
int defaultSmoothingDivisor();
void setSmoothingDivisor(v1::Smoothing& smoothing, int divisor);

/// Sets a number or a flag of a message, whether or not its annotation allows the value: studies go beyond it. False
/// where the message has no such field.
bool setField(google::protobuf::Message& message, std::string_view field, double value);

/// The largest value that a field's annotation allows; 0 where there is no such field or bound.
double largestAllowed(const google::protobuf::Message& message, std::string_view field);

}  // namespace sluice::evaluate
