#include "smoothing/methods.h"

#include <algorithm>

#include "sluice/core/check.h"
#include "sluice/scene/scene.h"

namespace sluice::evaluate {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::OneofDescriptor;
using google::protobuf::Reflection;

namespace {

constexpr const char* kDivisor = "divisor";

const OneofDescriptor& methodOneof() {
  const OneofDescriptor* const oneof = v1::Smoothing::descriptor()->FindOneofByName("method");
  SLUICE_CHECK(oneof != nullptr);
  return *oneof;
}

const FieldDescriptor* findField(const Message& message, std::string_view field) {
  return message.GetDescriptor()->FindFieldByName(std::string(field));
}

}  // namespace

std::string SmoothingMethod::stage() const {
  std::string words = name;
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::vector<SmoothingMethod> smoothingMethods() {
  const OneofDescriptor& oneof = methodOneof();
  const std::string& byDefault = oneof.options().GetExtension(v1::choice).default_member();
  std::vector<SmoothingMethod> methods;
  for (int i = 0; i < oneof.field_count(); ++i) {
    methods.push_back({oneof.field(i)->name(), oneof.field(i)->name() == byDefault});
  }
  return methods;
}

void chooseMethod(v1::Smoothing& smoothing, std::string_view method) {
  const FieldDescriptor* const field = findField(smoothing, method);
  SLUICE_CHECK(field != nullptr && field->containing_oneof() == &methodOneof());
  scene::complete(*smoothing.GetReflection()->MutableMessage(&smoothing, field));
}

Message& chosenMethod(v1::Smoothing& smoothing) {
  const Reflection& reflection = *smoothing.GetReflection();
  const FieldDescriptor* const field = reflection.GetOneofFieldDescriptor(smoothing, &methodOneof());
  SLUICE_CHECK(field != nullptr);
  return *reflection.MutableMessage(&smoothing, field);
}

double defaultSmoothingTime() { return v1::Smoothing().time(); }

std::vector<int> smoothingDivisors() {
  const FieldDescriptor* const field = findField(v1::Smoothing(), kDivisor);
  std::vector<int> divisors;
  if (field != nullptr) {
    for (const double allowed : field->options().GetExtension(v1::info).allowed()) {
      divisors.push_back(static_cast<int>(allowed));
    }
  }
  if (divisors.empty()) divisors.push_back(1);
  std::ranges::sort(divisors);
  return divisors;
}

int defaultSmoothingDivisor() {
  const FieldDescriptor* const field = findField(v1::Smoothing(), kDivisor);
  return field == nullptr ? 1 : static_cast<int>(field->default_value_uint32());
}

void setSmoothingDivisor(v1::Smoothing& smoothing, int divisor) {
  const bool set = setField(smoothing, kDivisor, divisor);
  SLUICE_CHECK(set || divisor == 1);
}

bool setField(Message& message, std::string_view name, double value) {
  const FieldDescriptor* const field = findField(message, name);
  if (field == nullptr || field->is_repeated()) return false;
  const Reflection& reflection = *message.GetReflection();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      reflection.SetDouble(&message, field, value);
      return true;
    case FieldDescriptor::CPPTYPE_UINT32:
      reflection.SetUInt32(&message, field, static_cast<std::uint32_t>(value));
      return true;
    case FieldDescriptor::CPPTYPE_BOOL:
      reflection.SetBool(&message, field, value != 0);
      return true;
    default:
      return false;
  }
}

double largestAllowed(const Message& message, std::string_view name) {
  const FieldDescriptor* const field = findField(message, name);
  return field == nullptr ? 0 : field->options().GetExtension(v1::info).max();
}

}  // namespace sluice::evaluate
