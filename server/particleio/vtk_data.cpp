#include "vtk_data.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "text_numbers.h"

namespace sluice::particleio {

namespace {

std::size_t sizeOf(VtkType type) {
  switch (type) {
    case VtkType::Bit:
    case VtkType::Int8:
    case VtkType::UInt8:
      return 1;
    case VtkType::Int16:
    case VtkType::UInt16:
      return 2;
    case VtkType::Int32:
    case VtkType::UInt32:
    case VtkType::Float:
      return 4;
    case VtkType::Int64:
    case VtkType::UInt64:
    case VtkType::Double:
      return 8;
  }
  return 1;
}

}  // namespace

std::optional<VtkType> vtkTypeNamed(std::string_view name) {
  using enum VtkType;
  // long has the 8 bytes of the 64-bit machines that write such files today.
  static constexpr auto kTypes = std::to_array<std::pair<std::string_view, VtkType>>({
      {"bit", Bit},
      {"char", Int8},
      {"signed_char", Int8},
      {"unsigned_char", UInt8},
      {"short", Int16},
      {"unsigned_short", UInt16},
      {"int", Int32},
      {"unsigned_int", UInt32},
      {"long", Int64},
      {"unsigned_long", UInt64},
      {"vtkidtype", Int32},  // legacy files store ids as int
      {"vtktypeint64", Int64},
      {"vtktypeuint64", UInt64},
      {"float", Float},
      {"double", Double},
  });
  std::string lower(name);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == lower; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

void VtkArrayReader::begin(std::uint64_t count, VtkType type, const char* what) {
  left_ = count;
  type_ = type;
  what_ = what;
  bitsLeft_ = 0;
  if (binary_) {
    reader_.line();  // what is left of the line before the numbers
    if (type == VtkType::Bit) {
      reader_.require(count / 8 + (count % 8 != 0 ? 1 : 0), 1, what);
    } else {
      reader_.require(count, sizeOf(type), what);
    }
  } else if (count > 0) {
    reader_.require(count, 2, what);  // a digit and a blank before it
  }
}

double VtkArrayReader::next() {
  --left_;
  if (!binary_) {
    const std::string_view word = reader_.word();
    const std::optional<double> value = parseNumber<double>(word);
    if (!value) reader_.fail(word.empty() ? "the file is cut off" : shown(word) + " is not a number");
    return *value;
  }
  constexpr std::endian kOrder = std::endian::big;
  switch (type_) {
    case VtkType::Bit:
      if (bitsLeft_ == 0) {
        bits_ = reader_.read<std::uint8_t>(kOrder, what_);
        bitsLeft_ = 8;
      }
      --bitsLeft_;
      return static_cast<double>((static_cast<unsigned>(bits_) >> static_cast<unsigned>(bitsLeft_)) & 1U);
    case VtkType::Int8:
      return reader_.read<std::int8_t>(kOrder, what_);
    case VtkType::UInt8:
      return reader_.read<std::uint8_t>(kOrder, what_);
    case VtkType::Int16:
      return reader_.read<std::int16_t>(kOrder, what_);
    case VtkType::UInt16:
      return reader_.read<std::uint16_t>(kOrder, what_);
    case VtkType::Int32:
      return reader_.read<std::int32_t>(kOrder, what_);
    case VtkType::UInt32:
      return reader_.read<std::uint32_t>(kOrder, what_);
    case VtkType::Int64:
      return static_cast<double>(reader_.read<std::int64_t>(kOrder, what_));
    case VtkType::UInt64:
      return static_cast<double>(reader_.read<std::uint64_t>(kOrder, what_));
    case VtkType::Float:
      return reader_.read<float>(kOrder, what_);
    case VtkType::Double:
      return reader_.read<double>(kOrder, what_);
  }
  return 0;
}

void VtkArrayReader::skip() {
  if (binary_ && type_ != VtkType::Bit) {
    reader_.skip(left_, sizeOf(type_), what_);
    left_ = 0;
  }
  while (left_ > 0) next();
}

}  // namespace sluice::particleio
