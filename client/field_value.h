#pragma once

#include <string>

#include <google/protobuf/message.h>

namespace sluice::client {

/// What people may write for a value of this field (or of one element of it): "a number", "true or false"...
std::string allowedValues(const google::protobuf::FieldDescriptor& field, bool element);

/// Sets `field` of `message`, or adds one element to it, to what `text` says; a list as a whole is written
/// [{...},{...}]. Returns what is wrong with the text, or nothing.
std::string setValue(google::protobuf::Message& message, const google::protobuf::FieldDescriptor& field, bool element,
                     const std::string& text);

}  // namespace sluice::client
