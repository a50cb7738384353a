#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sluice::render {

/// Pixels [left, right) × [top, bottom).
struct PixelBounds {
  std::int16_t left, right, top, bottom;

  bool isEmpty() const { return left >= right || top >= bottom; }
};

/// Which of many small things meet which strip of rows of a picture, in their order: what one thread draws of a strip
/// is then the same for any number of threads.
class StripBins {
 public:
  void fill(std::span<const PixelBounds> bounds, int height, int stripRows);

  int strips() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const std::uint32_t> met(int strip) const {
    const auto s = static_cast<std::size_t>(strip);
    return std::span(order_).subspan(start_[s], start_[s + 1] - start_[s]);
  }

 private:
  std::vector<std::uint32_t> start_{0};  ///< Strip s holds order_[start_[s]] to order_[start_[s + 1]].
  std::vector<std::uint32_t> order_;
};

}  // namespace sluice::render
