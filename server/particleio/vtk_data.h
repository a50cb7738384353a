#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "byte_reader.h"

namespace sluice::particleio {

/// The number types of VTK's legacy files.
enum class VtkType : std::uint8_t { Bit, Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float, Double };

/// "float", "unsigned_int", "vtktypeint64", … in any case of letters.
std::optional<VtkType> vtkTypeNamed(std::string_view name);

/// Reads the arrays of one file: big-endian numbers, or words.
class VtkArrayReader {
 public:
  VtkArrayReader(ByteReader& reader, bool binary) : reader_(reader), binary_(binary) {}

  /// To be called after the last word of the line before the numbers; throws where there cannot be as many.
  void begin(std::uint64_t count, VtkType type, const char* what);

  double next();

  /// The numbers of a whole array, between begin and end.
  void skip();

 private:
  ByteReader& reader_;
  bool binary_;
  std::uint64_t left_ = 0;
  VtkType type_ = VtkType::Float;
  const char* what_ = "";
  // Bits are packed eight to a byte, the first in the highest place.
  std::uint8_t bits_ = 0;
  int bitsLeft_ = 0;
};

}  // namespace sluice::particleio
