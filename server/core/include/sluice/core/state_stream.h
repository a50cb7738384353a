#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sluice/core/input_error.h"

namespace sluice::core {

static_assert(std::endian::native == std::endian::little, "saved states hold numbers as little-endian machines do");

/// What a saved state takes bit for bit: numbers, and structs of them, which are to be without padding.
template <class T>
concept StateValue = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::ranges::range<T>;

/// Appends to a saved state: numbers as they are in memory, texts and arrays behind their length (64 bits).
class StateWriter {
 public:
  template <StateValue T>
  void write(const T& value) {
    append(&value, sizeof value);
  }

  void write(std::string_view text) {
    write(std::uint64_t{text.size()});
    append(text.data(), text.size());
  }

  template <StateValue T>
  void write(std::span<const T> values) {
    write(std::uint64_t{values.size()});
    append(values.data(), values.size_bytes());
  }

  template <StateValue T>
  void write(const std::vector<T>& values) {
    write(std::span<const T>(values));
  }

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<std::uint8_t> bytes_;
};

/// Reads a saved state back, in the order in which it was written. Every function throws InputError where the bytes end
/// too early, before it takes memory for what they promise.
class StateReader {
 public:
  /// `name` is for messages alone; `bytes` must outlive the reader.
  StateReader(std::span<const std::uint8_t> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  template <StateValue T>
  void read(T& value) {
    std::memcpy(&value, take(1, sizeof value), sizeof value);
  }

  void read(std::string& text) {
    const std::uint64_t length = readLength();
    text.assign(reinterpret_cast<const char*>(take(length, 1)), length);
  }

  template <StateValue T>
  void read(std::vector<T>& values) {
    const std::uint64_t count = readLength();
    const std::uint8_t* data = take(count, sizeof(T));
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), data, count * sizeof(T));
  }

  /// Throws unless a text stands next: what tells one part of a state from another.
  void expect(std::string_view text) {
    std::string found;
    read(found);
    if (found != text) fail("the part \"" + std::string(text) + "\" is missing");
  }

  bool atEnd() const { return bytes_.empty(); }

  [[noreturn]] void fail(const std::string& problem) const { throw InputError(name_, "", problem); }

 private:
  std::uint64_t readLength() {
    std::uint64_t length = 0;
    read(length);
    return length;
  }

  const std::uint8_t* take(std::uint64_t count, std::size_t size) {
    if (count > bytes_.size() / size) fail("the state is cut off");
    const std::uint8_t* data = bytes_.data();
    bytes_ = bytes_.subspan(count * size);
    return data;
  }

  std::span<const std::uint8_t> bytes_;
  std::string name_;
};

}  // namespace sluice::core
