#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "byte_reader.h"

namespace sluice::particleio {

/// A type of numbers in a PLY file.
enum class PlyType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float;
  std::optional<PlyType> countType;  ///< Set for lists.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The least bytes that one of them takes: binary, or a digit and a blank for each number.
  std::uint64_t leastSize(bool binary) const;
};

/// Stanford PLY 1.0: a header in words, then the elements in its order, in words or binary of either byte order.
/// Whoever reads the elements asks for their numbers one by one, in the order of the header.
class PlyReader {
 public:
  /// Reads the header.
  PlyReader(std::span<const std::uint8_t> bytes, const std::string& name);

  const std::string& fileName() const { return reader_.fileName(); }
  const std::vector<PlyElement>& elements() const { return elements_; }

  /// Throws unless as many elements as the header promises can still be there: to be asked before memory is taken.
  void checkSize(const PlyElement& element) const;

  double number(PlyType type);

  /// The count that stands before a list's numbers; so many can still be there.
  std::uint64_t listLength(const PlyProperty& list);

  void skip(const PlyProperty& property);
  void skip(const PlyElement& element);

  [[noreturn]] void fail(const std::string& problem) const { reader_.fail(problem); }

 private:
  std::string_view word();
  void readHeader();
  void readFormat();
  void readElement();
  void readProperty();
  PlyType readType(std::string_view name) const;

  ByteReader reader_;
  std::string_view line_;  ///< What is left of the header's line.
  bool binary_ = false;
  std::endian order_ = std::endian::little;
  std::vector<PlyElement> elements_;
};

}  // namespace sluice::particleio
