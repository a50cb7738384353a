#include "annotations.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "sluice/v1/scene.pb.h"

namespace sluice::scene {

const v1::FieldInfo& infoOf(const FieldDescriptor& field) { return field.options().GetExtension(v1::info); }

bool isMessage(const FieldDescriptor& field) { return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE; }

bool isVector(const FieldDescriptor& field) {
  return isMessage(field) && field.message_type() == v1::Vec3::descriptor();
}

bool isNumber(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_INT64:
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64:
      return true;
    default:
      return isFloatingPoint(field);
  }
}

bool isFloatingPoint(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE || field.cpp_type() == FieldDescriptor::CPPTYPE_FLOAT;
}

std::string formatNumber(double value) {
  std::array<char, 32> buffer;  // the longest shortest form of a double has 24 characters
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), end);
  // 1e+05 -> 1e5, 1e-06 -> 1e-6
  if (const std::size_t exponent = text.find('e'); exponent != std::string::npos) {
    std::size_t digits = exponent + 1;
    if (text[digits] == '-') {
      ++digits;
    } else if (text[digits] == '+') {
      text.erase(digits, 1);
    }
    while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  }
  return text;
}

std::string allowedText(const v1::FieldInfo& info) {
  std::string text;
  if (info.allowed_size() > 0) {
    for (int i = 0; i < info.allowed_size(); ++i) {
      if (i > 0) text += i + 1 < info.allowed_size() ? ", " : " or ";
      text += formatNumber(info.allowed(i));
    }
  } else if (info.has_min() && info.has_max()) {
    text.append("[").append(formatNumber(info.min())).append(", ").append(formatNumber(info.max())).append("]");
  } else if (info.has_min()) {
    text = "at least " + formatNumber(info.min());
  } else if (info.has_max()) {
    text = "at most " + formatNumber(info.max());
  } else {
    return {};
  }
  if (!info.unit().empty()) text.append(" ").append(info.unit());
  return text;
}

std::string numberProblem(double value, const v1::FieldInfo& info) {
  const std::string allowed = allowedText(info);
  if (!std::isfinite(value)) {
    return formatNumber(value) + " is not a finite number" + (allowed.empty() ? "" : "; allowed is " + allowed);
  }
  if ((info.has_min() && value < info.min()) || (info.has_max() && value > info.max())) {
    const bool bothEnds = info.has_min() && info.has_max() && info.allowed_size() == 0;
    return formatNumber(value) + (bothEnds ? " is outside " : " is not allowed; allowed is ") + allowed;
  }
  const auto& values = info.allowed();
  if (!values.empty() && std::find(values.begin(), values.end(), value) == values.end()) {
    return formatNumber(value) + " is not allowed; allowed is " + allowed;
  }
  return {};
}

}  // namespace sluice::scene
