#include "field_value.h"

#include <memory>
#include <string_view>
#include <vector>

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include "sluice/client/failure.h"
#include "sluice/client/option_values.h"

namespace sluice::client {

namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::TextFormat;

/// Keeps the first complaint of the text parser, which otherwise goes to the log.
class FirstError : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int /*line*/, google::protobuf::io::ColumnNumber /*column*/, const std::string& message) override {
    if (text_.empty()) text_ = message;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

bool isVector(const FieldDescriptor& field) {
  return field.message_type() != nullptr && field.message_type() == v1::Vec3::descriptor();
}

/// "name: value" could go on with other fields behind the value; only the one that was named may come of it.
bool holdsOnly(const Message& message, const FieldDescriptor& field) {
  std::vector<const FieldDescriptor*> present;
  message.GetReflection()->ListFields(message, &present);
  return present.empty() || (present.size() == 1 && present.front() == &field);
}

}  // namespace

std::string allowedValues(const FieldDescriptor& field, bool element) {
  if (field.is_repeated() && !element) return "a list such as [{...},{...}]";
  if (isVector(field)) return "three numbers x,y,z";
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return "a message such as {} or {field: value}";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64:
      return "a whole number, not negative";
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_INT64:
      return "a whole number";
    case FieldDescriptor::CPPTYPE_ENUM:
      return "a name of " + field.enum_type()->name();
    case FieldDescriptor::CPPTYPE_STRING:
      return "text";
    default:
      return "a number";
  }
}

std::string setValue(Message& message, const FieldDescriptor& field, bool element, const std::string& text) {
  const auto* reflection = message.GetReflection();
  const bool braced = text.starts_with('{');
  if (isVector(field) && !braced && (element || !field.is_repeated())) {
    try {
      const v1::Vec3 vector = parseVector(text);
      Message* target =
          element ? reflection->AddMessage(&message, &field) : reflection->MutableMessage(&message, &field);
      target->CopyFrom(vector);
      return {};
    } catch (const UsageError& error) {
      return error.what();
    }
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING && !field.is_repeated()) {
    reflection->SetString(&message, &field, text);
    return {};
  }

  FirstError error;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  if (field.is_repeated() && !element) {
    const std::unique_ptr<Message> alone(message.New());
    if (!parser.ParseFromString(field.name() + ": " + text, alone.get())) return error.text();
    if (!holdsOnly(*alone, field)) return "it goes on behind the list";
    message.MergeFrom(*alone);
    return {};
  }
  return parser.ParseFieldValueFromString(text, &field, &message) ? std::string()
         : error.text().empty()                                   ? "it goes on behind the value"
                                                                  : error.text();
}

}  // namespace sluice::client
