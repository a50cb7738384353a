#include "validate.h"

#include <algorithm>
#include <array>

#include "annotations.h"
#include "names.h"
#include "sluice/core/check.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"

namespace sluice::scene {

using google::protobuf::Message;
using google::protobuf::Reflection;

namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

double numberOf(const Message& message, const FieldDescriptor& field) {
  const Reflection& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.GetInt32(message, &field);
    case FieldDescriptor::CPPTYPE_INT64:
      return static_cast<double>(reflection.GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.GetUInt32(message, &field);
    case FieldDescriptor::CPPTYPE_UINT64:
      return static_cast<double>(reflection.GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return reflection.GetFloat(message, &field);
    default:
      return reflection.GetDouble(message, &field);
  }
}

/// A value as people write it: "0.05", "(1, 2, 3)".
std::string valueText(const Message& holder, const FieldDescriptor& field) {
  if (!isVector(field)) return formatNumber(numberOf(holder, field));
  const auto& v = static_cast<const v1::Vec3&>(holder.GetReflection()->GetMessage(holder, &field));
  std::string text = "(";
  text.append(formatNumber(v.x())).append(", ").append(formatNumber(v.y())).append(", ").append(formatNumber(v.z()));
  return text + ")";
}

/// Text that people are shown has to be UTF-8; JSON and browsers refuse anything else.
bool isUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xc2 && lead < 0xe0 ? 2 : (lead & 0xf0U) == 0xe0 ? 3 : 4;
    if ((lead >= 0x80 && lead < 0xc2) || lead > 0xf4 || i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0U) != 0x80) return false;
    }
    i += length;
  }
  return true;
}

class Validator {
 public:
  /// Returns false at the first problem, which then stands in `problem`.
  bool check(const Message& message) {
    const google::protobuf::Descriptor& type = *message.GetDescriptor();
    for (int i = 0; i < type.field_count(); ++i) {
      const FieldDescriptor& field = *type.field(i);
      path_.push_back({&field, -1});
      const bool good = field.is_repeated() ? checkRepeated(message, field) : checkSingular(message, field);
      if (!good) return false;
      path_.pop_back();
    }
    return true;
  }

  std::optional<Problem> problem;

 private:
  bool fail(std::string text) {
    problem = {path_, std::move(text)};
    return false;
  }

  bool checkRepeated(const Message& message, const FieldDescriptor& field) {
    const v1::FieldInfo& info = infoOf(field);
    const Reflection& reflection = *message.GetReflection();
    const auto size = static_cast<std::uint32_t>(reflection.FieldSize(message, &field));
    if (size < info.min_items()) {
      return fail("has " + std::to_string(size) + " elements; needs at least " + std::to_string(info.min_items()));
    }
    if (info.max_items() > 0 && size > info.max_items()) {
      return fail("has " + std::to_string(size) + " elements; allowed are at most " + std::to_string(info.max_items()));
    }
    if (!isMessage(field)) return true;
    for (std::uint32_t i = 0; i < size; ++i) {
      path_.back().index = static_cast<int>(i);
      if (!check(reflection.GetRepeatedMessage(message, &field, path_.back().index))) return false;
    }
    return true;
  }

  bool checkSingular(const Message& message, const FieldDescriptor& field) {
    const v1::FieldInfo& info = infoOf(field);
    const Reflection& reflection = *message.GetReflection();
    if (!reflection.HasField(message, &field)) {
      return info.required() ? fail("is missing; " + (info.doc().empty() ? "it must be set" : info.doc())) : true;
    }
    bool good = true;
    if (isVector(field)) {
      good = checkVector(static_cast<const v1::Vec3&>(reflection.GetMessage(message, &field)), info);
    } else if (isMessage(field)) {
      good = check(reflection.GetMessage(message, &field));
    } else if (isNumber(field)) {
      const std::string text = numberProblem(numberOf(message, field), info);
      good = text.empty() || fail(text);
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
      good = checkText(reflection.GetString(message, &field), info);
    }
    return good && checkBeside(message, field, info);
  }

  bool checkVector(const v1::Vec3& v, const v1::FieldInfo& info) {
    const std::array<double, 3> components{v.x(), v.y(), v.z()};
    for (std::size_t axis = 0; axis < components.size(); ++axis) {
      const std::string text = numberProblem(components[axis], info);
      if (text.empty()) continue;
      path_.push_back({v1::Vec3::descriptor()->FindFieldByName(kAxes[axis]), -1});
      return fail(text);
    }
    if (info.nonzero() && components == std::array<double, 3>{}) return fail("must not be of length 0");
    return true;
  }

  bool checkText(const std::string& text, const v1::FieldInfo& info) {
    if (info.required() && text.empty()) return fail("must not be empty");
    if (!isUtf8(text)) return fail("is not valid UTF-8");
    const std::vector<std::string> words(info.words().begin(), info.words().end());
    if (words.empty() || text.empty() || std::ranges::find(words, text) != words.end()) return true;
    return fail(inQuotes(text) + " is none of the words allowed; " + suggestNames(text, words));
  }

  /// The annotations `below` and `at_most`, which compare a field with another of the same message.
  bool checkBeside(const Message& message, const FieldDescriptor& field, const v1::FieldInfo& info) {
    const bool strict = !info.below().empty();
    const std::string& name = strict ? info.below() : info.at_most();
    if (name.empty()) return true;
    const FieldDescriptor* other = message.GetDescriptor()->FindFieldByName(name);
    SLUICE_CHECK(other != nullptr);
    const Reflection& reflection = *message.GetReflection();
    if (!reflection.HasField(message, other)) return true;

    bool good = true;
    const auto compare = [&](double a, double b) { good = good && (strict ? a < b : a <= b); };
    if (isVector(field)) {
      const auto& a = static_cast<const v1::Vec3&>(reflection.GetMessage(message, &field));
      const auto& b = static_cast<const v1::Vec3&>(reflection.GetMessage(message, other));
      compare(a.x(), b.x());
      compare(a.y(), b.y());
      compare(a.z(), b.z());
    } else {
      compare(numberOf(message, field), numberOf(message, *other));
    }
    return good || fail(valueText(message, field) + " must be " + (strict ? "below " : "at most ") + name + ", " +
                        valueText(message, *other) + (isVector(field) ? ", in every component" : ""));
  }

  FieldPath path_;
};

}  // namespace

std::optional<Problem> findProblem(const Message& message) {
  Validator validator;
  validator.check(message);
  return validator.problem;
}

void validate(const Message& message, const std::string& pathPrefix) {
  if (const std::optional<Problem> problem = findProblem(message)) {
    throw core::InputError("", joinPaths(pathPrefix, toString(problem->path)), problem->text);
  }
}

}  // namespace sluice::scene
