#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "sluice/core/input_error.h"

namespace sluice::particleio {

/// Walks over the bytes of a file and never past their end.
class ByteReader {
 public:
  ByteReader(std::span<const std::uint8_t> bytes, std::string fileName)
      : bytes_(bytes), fileName_(std::move(fileName)) {}

  const std::string& fileName() const { return fileName_; }
  std::size_t offset() const { return offset_; }
  std::size_t remaining() const { return bytes_.size() - offset_; }
  bool atEnd() const { return offset_ == bytes_.size(); }
  int peek() const { return atEnd() ? -1 : bytes_[offset_]; }

  /// Throws unless `count` elements of `elementSize` bytes are still there: to be asked before memory is taken.
  void require(std::uint64_t count, std::uint64_t elementSize, const char* what) const {
    if (elementSize == 0 || count <= remaining() / elementSize) return;
    // Counts that lie may overflow the product.
    const bool huge = count > std::numeric_limits<std::uint64_t>::max() / elementSize;
    fail("the file is cut off: " + std::string(what) + " needs " +
         (huge ? std::string("more than 2^64") : std::to_string(count * elementSize)) + " bytes, " +
         std::to_string(remaining()) + " are left");
  }

  template <class T>
  T read(std::endian order, const char* what) {
    require(1, sizeof(T), what);
    std::array<std::uint8_t, sizeof(T)> raw;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset_), sizeof(T), raw.begin());
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    offset_ += sizeof(T);
    return std::bit_cast<T>(raw);
  }

  void skip(std::uint64_t count, std::uint64_t elementSize, const char* what) {
    require(count, elementSize, what);
    offset_ += count * elementSize;
  }

  std::string_view text(std::size_t length, const char* what) {
    require(length, 1, what);
    const std::string_view result(reinterpret_cast<const char*>(bytes_.data()) + offset_, length);
    offset_ += length;
    return result;
  }

  /// Up to the next line break, which is consumed and left out, as is a carriage return before it.
  std::string_view line() {
    const std::string_view rest(reinterpret_cast<const char*>(bytes_.data()) + offset_, remaining());
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    offset_ += std::min(end + 1, rest.size());
    std::string_view result = rest.substr(0, end);
    if (result.ends_with('\r')) result.remove_suffix(1);
    return result;
  }

  /// The next run of characters that are not blank; empty at the end of the file. The blank after it stays.
  std::string_view word() {
    const auto blank = [](std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (offset_ < bytes_.size() && blank(bytes_[offset_])) ++offset_;
    const std::size_t start = offset_;
    while (offset_ < bytes_.size() && !blank(bytes_[offset_])) ++offset_;
    return {reinterpret_cast<const char*>(bytes_.data()) + start, offset_ - start};
  }

  void rewindTo(std::size_t offset) { offset_ = offset; }

  [[noreturn]] void fail(const std::string& problem) const {
    throw core::InputError(fileName_, "", "at byte " + std::to_string(offset_) + ": " + problem);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t offset_ = 0;
  std::string fileName_;
};

}  // namespace sluice::particleio
