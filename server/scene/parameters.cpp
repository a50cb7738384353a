#include "sluice/scene/parameters.h"

#include <google/protobuf/text_format.h>

#include "annotations.h"
#include "field_path.h"
#include "sluice/core/check.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::scene {

namespace {

std::string typeName(const FieldDescriptor& field) {
  if (field.is_repeated()) return "list";
  if (isVector(field)) return infoOf(field).colour() ? "colour" : "vector";
  if (isMessage(field)) return field.real_containing_oneof() != nullptr ? "choice" : "group";
  if (isFloatingPoint(field)) return "number";
  if (isNumber(field)) return "whole number";
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return "yes or no";
    case FieldDescriptor::CPPTYPE_ENUM:
      return "name";
    default:
      return "text";
  }
}

std::string vectorDefault(const v1::FieldInfo& info) {
  v1::Vec3 v;
  SLUICE_CHECK(google::protobuf::TextFormat::ParseFromString(info.default_text(), &v));
  return formatNumber(v.x()) + "," + formatNumber(v.y()) + "," + formatNumber(v.z());
}

std::string defaultValue(const FieldDescriptor& field) {
  const v1::FieldInfo& info = infoOf(field);
  if (info.required() || field.is_repeated()) return {};
  if (isVector(field)) return vectorDefault(info);
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return std::to_string(field.default_value_int32());
    case FieldDescriptor::CPPTYPE_INT64:
      return std::to_string(field.default_value_int64());
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(field.default_value_uint32());
    case FieldDescriptor::CPPTYPE_UINT64:
      return std::to_string(field.default_value_uint64());
    case FieldDescriptor::CPPTYPE_FLOAT:
      return formatNumber(static_cast<double>(field.default_value_float()));
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return formatNumber(field.default_value_double());
    case FieldDescriptor::CPPTYPE_BOOL:
      return field.default_value_bool() ? "true" : "false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return field.default_value_enum()->name();
    case FieldDescriptor::CPPTYPE_STRING:
      return field.default_value_string();
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return {};
  }
  return {};
}

void collect(const google::protobuf::Descriptor& type, const std::string& prefix, std::vector<Parameter>& result) {
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    Parameter parameter;
    parameter.path = joinPaths(prefix, field.name());
    parameter.type = typeName(field);
    parameter.defaultValue = defaultValue(field);
    parameter.info = infoOf(field);
    if (const auto* oneof = field.real_containing_oneof()) {
      parameter.choiceOf = joinPaths(prefix, oneof->name());
      parameter.chosenByDefault = oneof->options().GetExtension(v1::choice).default_member() == field.name();
    }
    const bool group = isMessage(field) && !isVector(field);
    const std::string inner = parameter.path + (field.is_repeated() ? "[0]" : "");
    // A group that a scene always has says nothing by itself; its fields do.
    if (parameter.type != "group" || parameter.info.feature() || parameter.info.required()) {
      result.push_back(std::move(parameter));
    }
    if (group) collect(*field.message_type(), inner, result);
  }
}

}  // namespace

std::vector<Parameter> parameters() {
  std::vector<Parameter> result;
  collect(*v1::Scene::descriptor(), "", result);
  return result;
}

}  // namespace sluice::scene
