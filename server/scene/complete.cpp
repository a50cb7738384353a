#include <google/protobuf/text_format.h>

#include "annotations.h"
#include "sluice/core/check.h"
#include "sluice/scene/scene.h"

namespace sluice::scene {

using google::protobuf::Message;
using google::protobuf::OneofDescriptor;
using google::protobuf::Reflection;

namespace {

void chooseDefaultMembers(Message& message) {
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  const Reflection& reflection = *message.GetReflection();
  for (int i = 0; i < type.real_oneof_decl_count(); ++i) {
    const OneofDescriptor& oneof = *type.oneof_decl(i);
    const std::string& member = oneof.options().GetExtension(v1::choice).default_member();
    if (member.empty() || reflection.HasOneof(message, &oneof)) continue;
    const FieldDescriptor* field = type.FindFieldByName(member);
    SLUICE_CHECK(field != nullptr && field->containing_oneof() == &oneof && isMessage(*field));
    reflection.MutableMessage(&message, field);
  }
}

void setToDefault(Message& message, const FieldDescriptor& field) {
  const Reflection& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.SetInt32(&message, &field, field.default_value_int32());
    case FieldDescriptor::CPPTYPE_INT64:
      return reflection.SetInt64(&message, &field, field.default_value_int64());
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.SetUInt32(&message, &field, field.default_value_uint32());
    case FieldDescriptor::CPPTYPE_UINT64:
      return reflection.SetUInt64(&message, &field, field.default_value_uint64());
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.SetDouble(&message, &field, field.default_value_double());
    case FieldDescriptor::CPPTYPE_FLOAT:
      return reflection.SetFloat(&message, &field, field.default_value_float());
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.SetBool(&message, &field, field.default_value_bool());
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.SetEnum(&message, &field, field.default_value_enum());
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.SetString(&message, &field, field.default_value_string());
    case FieldDescriptor::CPPTYPE_MESSAGE:
      SLUICE_CHECK(!"messages have no default value");
  }
}

void completeField(Message& message, const FieldDescriptor& field) {
  const Reflection& reflection = *message.GetReflection();
  if (field.is_repeated()) {
    if (!isMessage(field)) return;
    for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
      complete(*reflection.MutableRepeatedMessage(&message, &field, i));
    }
    return;
  }
  const v1::FieldInfo& info = infoOf(field);
  if (!reflection.HasField(message, &field)) {
    // A required field stays absent, so that validate can name it.
    if (field.real_containing_oneof() != nullptr || info.feature() || info.required()) return;
    if (!isMessage(field)) return setToDefault(message, field);
    Message* child = reflection.MutableMessage(&message, &field);
    SLUICE_CHECK(google::protobuf::TextFormat::MergeFromString(info.default_text(), child));
  }
  if (isMessage(field)) complete(*reflection.MutableMessage(&message, &field));
}

}  // namespace

void complete(Message& message) {
  chooseDefaultMembers(message);
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) completeField(message, *type.field(i));
}

}  // namespace sluice::scene
