#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

namespace sluice::particleio {

/// Appends numbers in a byte order, and text.
class ByteWriter {
 public:
  explicit ByteWriter(std::endian order) : order_(order) {}

  template <class T>
  void write(T value) {
    auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }

  void text(std::string_view text) {
    for (const char c : text) bytes_.push_back(static_cast<std::uint8_t>(c));
  }

  std::vector<std::uint8_t> take() && { return std::move(bytes_); }

 private:
  std::endian order_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace sluice::particleio
