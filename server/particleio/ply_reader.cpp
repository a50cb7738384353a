#include "ply_reader.h"

#include <algorithm>
#include <array>

#include "text_numbers.h"

namespace sluice::particleio {

namespace {

std::optional<PlyType> typeNamed(std::string_view name) {
  using enum PlyType;
  static constexpr auto kTypes = std::to_array<std::pair<std::string_view, PlyType>>({{"char", Int8},
                                                                                      {"int8", Int8},
                                                                                      {"uchar", UInt8},
                                                                                      {"uint8", UInt8},
                                                                                      {"short", Int16},
                                                                                      {"int16", Int16},
                                                                                      {"ushort", UInt16},
                                                                                      {"uint16", UInt16},
                                                                                      {"int", Int32},
                                                                                      {"int32", Int32},
                                                                                      {"uint", UInt32},
                                                                                      {"uint32", UInt32},
                                                                                      {"float", Float},
                                                                                      {"float32", Float},
                                                                                      {"double", Double},
                                                                                      {"float64", Double}});
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == name; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

std::size_t sizeOf(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::UInt8:
      return 1;
    case PlyType::Int16:
    case PlyType::UInt16:
      return 2;
    case PlyType::Double:
      return 8;
    default:
      return 4;
  }
}

}  // namespace

std::uint64_t PlyElement::leastSize(bool binary) const {
  std::uint64_t size = 0;
  for (const PlyProperty& property : properties) {
    size += binary ? sizeOf(property.countType.value_or(property.type)) : 2;
  }
  return size;
}

PlyReader::PlyReader(std::span<const std::uint8_t> bytes, const std::string& name) : reader_(bytes, name) {
  readHeader();
}

std::string_view PlyReader::word() {
  const std::size_t blank = std::min(line_.find(' '), line_.size());
  const std::string_view result = line_.substr(0, blank);
  line_.remove_prefix(std::min(line_.find_first_not_of(' ', blank), line_.size()));
  return result;
}

void PlyReader::readHeader() {
  if (reader_.line() != "ply") {
    throw core::InputError(reader_.fileName(), "", "is not a PLY file: its first line is not \"ply\"");
  }
  bool formatKnown = false;
  while (true) {
    if (reader_.atEnd()) reader_.fail("the file is cut off: end_header is missing");
    line_ = reader_.line();
    const std::string_view keyword = word();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      readFormat();
      formatKnown = true;
    } else if (keyword == "element") {
      readElement();
    } else if (keyword == "property") {
      readProperty();
    } else if (keyword != "comment" && keyword != "obj_info") {
      reader_.fail("the header's line " + shown(keyword) + " is not known");
    }
  }
  if (!formatKnown) reader_.fail("the header has no line \"format\"");
}

void PlyReader::readFormat() {
  const std::string_view format = word();
  binary_ = format != "ascii";
  order_ = format == "binary_big_endian" ? std::endian::big : std::endian::little;
  if (binary_ && format != "binary_big_endian" && format != "binary_little_endian") {
    reader_.fail(shown(format) + " is not a format; known are ascii, binary_little_endian, binary_big_endian");
  }
}

void PlyReader::readElement() {
  PlyElement element;
  element.name = std::string(word());
  const std::string_view count = word();
  const auto parsed = parseNumber<std::uint64_t>(count);
  if (!parsed) reader_.fail(shown(count) + " is not a count of elements");
  element.count = *parsed;
  elements_.push_back(std::move(element));
}

void PlyReader::readProperty() {
  if (elements_.empty()) reader_.fail("a property stands before any element");
  PlyProperty property;
  std::string_view type = word();
  if (type == "list") {
    property.countType = readType(word());
    if (*property.countType >= PlyType::Float) reader_.fail("the count of a list is not a whole number");
    type = word();
  }
  property.type = readType(type);
  property.name = std::string(word());
  elements_.back().properties.push_back(std::move(property));
}

PlyType PlyReader::readType(std::string_view name) const {
  const std::optional<PlyType> type = typeNamed(name);
  if (!type) reader_.fail(shown(name) + " is not a type of numbers");
  return *type;
}

double PlyReader::number(PlyType type) {
  constexpr const char* kWhat = "an element";
  if (!binary_) {
    const std::string_view text = reader_.word();
    const std::optional<double> value = parseNumber<double>(text);
    if (!value) reader_.fail(text.empty() ? "the file is cut off" : shown(text) + " is not a number");
    return *value;
  }
  switch (type) {
    case PlyType::Int8:
      return reader_.read<std::int8_t>(order_, kWhat);
    case PlyType::UInt8:
      return reader_.read<std::uint8_t>(order_, kWhat);
    case PlyType::Int16:
      return reader_.read<std::int16_t>(order_, kWhat);
    case PlyType::UInt16:
      return reader_.read<std::uint16_t>(order_, kWhat);
    case PlyType::Int32:
      return reader_.read<std::int32_t>(order_, kWhat);
    case PlyType::UInt32:
      return reader_.read<std::uint32_t>(order_, kWhat);
    case PlyType::Float:
      return reader_.read<float>(order_, kWhat);
    case PlyType::Double:
      return reader_.read<double>(order_, kWhat);
  }
  return 0;
}

std::uint64_t PlyReader::listLength(const PlyProperty& list) {
  const double length = number(*list.countType);
  if (!(length >= 0)) reader_.fail("the count of a list is negative");
  // In words, even the last number takes a digit.
  const auto count = static_cast<std::uint64_t>(std::min(length, 1e15));
  reader_.require(count, binary_ ? sizeOf(list.type) : 1, "a list");
  return count;
}

void PlyReader::skip(const PlyProperty& property) {
  const std::uint64_t count = property.countType ? listLength(property) : 1;
  if (binary_) return reader_.skip(count, sizeOf(property.type), "an element");
  for (std::uint64_t i = 0; i < count; ++i) number(property.type);
}

void PlyReader::skip(const PlyElement& element) {
  checkSize(element);
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    for (const PlyProperty& property : element.properties) skip(property);
  }
}

void PlyReader::checkSize(const PlyElement& element) const {
  const std::uint64_t least = element.leastSize(binary_);
  // The last number of a text needs no blank after it.
  if (!binary_ && least > 0 && element.count <= (reader_.remaining() + 1) / least) return;
  reader_.require(element.count, least, ("the element \"" + element.name + "\"").c_str());
}

}  // namespace sluice::particleio
