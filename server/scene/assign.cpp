#include <charconv>
#include <optional>

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include "annotations.h"
#include "field_path.h"
#include "names.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/looks.h"
#include "sluice/scene/scene.h"

namespace sluice::scene {

using core::InputError;
using google::protobuf::Message;
using google::protobuf::Reflection;

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

template <class Number>
std::optional<Number> parseNumber(std::string_view text) {
  text = trimmed(text);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(const std::string& path, std::string_view value, const std::string& expected,
                         const v1::FieldInfo& info) {
  const std::string allowed = allowedText(info);
  throw InputError("", path,
                   inQuotes(value) + " is not " + expected + (allowed.empty() ? "" : "; allowed is " + allowed));
}

/// "1,2,3".
std::optional<v1::Vec3> parseVector(std::string_view text) {
  const std::size_t first = text.find(',');
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = text.find(',', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const auto x = parseNumber<double>(text.substr(0, first));
  const auto y = parseNumber<double>(text.substr(first + 1, second - first - 1));
  const auto z = parseNumber<double>(text.substr(second + 1));
  if (!x || !y || !z) return std::nullopt;
  v1::Vec3 v;
  v.set_x(*x);
  v.set_y(*y);
  v.set_z(*z);
  return v;
}

class FirstMessage : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int, google::protobuf::io::ColumnNumber, const std::string& message) override {
    if (text.empty()) text = message;
  }
  std::string text;
};

/// "{depth_deviation_in_radii: 2}".
void setMessage(Message& target, const std::string& path, const FieldDescriptor& field, const std::string& value) {
  if (isVector(field) && !value.starts_with('{')) {
    const std::optional<v1::Vec3> v = parseVector(value);
    if (!v) refuse(path, value, "a vector such as 1,2,3", infoOf(field));
    target.CopyFrom(*v);
    return;
  }
  if (!value.starts_with('{') || !value.ends_with('}')) {
    throw InputError("", path,
                     inQuotes(value) + " is not a group of fields: write {} or {name: value …}; its fields are " +
                         joinNames(fieldNames(*field.message_type())));
  }
  constexpr int kDeepest = 32;
  FirstMessage error;
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  parser.SetRecursionLimit(kDeepest);
  target.Clear();
  if (!parser.MergeFromString(value.substr(1, value.size() - 2), &target)) {
    throw InputError("", path, "in " + inQuotes(value) + ": " + error.text);
  }
}

template <class Number>
Number number(const std::string& path, const std::string& value, const FieldDescriptor& field) {
  const auto parsed = parseNumber<Number>(value);
  if (!parsed) refuse(path, value, isFloatingPoint(field) ? "a number" : "a whole number", infoOf(field));
  return *parsed;
}

bool boolean(const std::string& path, const std::string& value) {
  if (value == "true" || value == "1") return true;
  if (value == "false" || value == "0") return false;
  throw InputError("", path, inQuotes(value) + " is not true or false");
}

int enumNumber(const std::string& path, const std::string& value, const FieldDescriptor& field) {
  const google::protobuf::EnumDescriptor& type = *field.enum_type();
  if (const auto* found = type.FindValueByName(value)) return found->number();
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) names.push_back(type.value(i)->name());
  throw InputError("", path, inQuotes(value) + " is not a value of it; " + suggestNames(value, names));
}

void setScalar(const Place& place, const std::string& path, const std::string& value) {
  const FieldDescriptor& field = *place.step.field;
  Message* holder = place.holder;
  const Reflection& set = *holder->GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return set.SetInt32(holder, &field, number<std::int32_t>(path, value, field));
    case FieldDescriptor::CPPTYPE_INT64:
      return set.SetInt64(holder, &field, number<std::int64_t>(path, value, field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return set.SetUInt32(holder, &field, number<std::uint32_t>(path, value, field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return set.SetUInt64(holder, &field, number<std::uint64_t>(path, value, field));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return set.SetFloat(holder, &field, number<float>(path, value, field));
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return set.SetDouble(holder, &field, number<double>(path, value, field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return set.SetBool(holder, &field, boolean(path, value));
    case FieldDescriptor::CPPTYPE_ENUM:
      return set.SetEnumValue(holder, &field, enumNumber(path, value, field));
    case FieldDescriptor::CPPTYPE_STRING:
      return set.SetString(holder, &field, value);
    case FieldDescriptor::CPPTYPE_MESSAGE:
      break;
  }
}

void assignOne(v1::Scene& scene, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("", "",
                     inQuotes(assignment) + " is not an assignment; write path=value, such as look.smoothing.time=2");
  }
  const std::string path(trimmed(std::string_view(assignment).substr(0, equals)));
  const std::string value(trimmed(std::string_view(assignment).substr(equals + 1)));
  const Place place = resolve(scene, path, PastTheEnd::Appends);
  const FieldDescriptor& field = *place.step.field;
  const Reflection& reflection = *place.holder->GetReflection();
  if (field.is_repeated() && (place.step.index < 0 || !isMessage(field))) {
    throw InputError("", path, field.name() + " is a list; set one element, as in " + field.name() + "[0]");
  }
  if (!isMessage(field)) {
    setScalar(place, path, value);
    if (isPreset(field)) replaceByPreset(static_cast<v1::Look&>(*place.holder));
    return;
  }
  Message* target = field.is_repeated() ? reflection.MutableRepeatedMessage(place.holder, &field, place.step.index)
                                        : reflection.MutableMessage(place.holder, &field);
  setMessage(*target, path, field, value);
  if (field.message_type() == v1::Look::descriptor()) applyPreset(static_cast<v1::Look&>(*target));
}

}  // namespace

void assign(v1::Scene& scene, std::span<const std::string> assignments) {
  v1::Scene changed = scene;
  for (const std::string& assignment : assignments) {
    assignOne(changed, assignment);
    // So that a path into a member chosen a moment ago finds the defaults of that member.
    complete(changed);
  }
  validate(changed);
  scene = std::move(changed);
}

}  // namespace sluice::scene
