#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sluice::render {

/// A picture of floats with one pixel of zeros all around, so that filters need no special case at the borders.
class PaddedField {
 public:
  /// Makes room for a picture; what it holds is left to be filled in, but for the zeros around.
  void fit(int width, int height) {
    stride_ = static_cast<std::size_t>(width) + 2;
    const std::size_t needed = stride_ * (static_cast<std::size_t>(height) + 2);
    if (values_.size() < needed) values_.resize(needed);
    std::fill_n(row(-1) - 1, stride_, 0.0F);
    std::fill_n(row(height) - 1, stride_, 0.0F);
    for (int y = 0; y < height; ++y) row(y)[-1] = row(y)[width] = 0.0F;
  }

  /// Pixel 0 of a row; rows -1 and height, and pixels -1 and width, are the padding.
  float* row(int y) { return values_.data() + offset(y); }
  const float* row(int y) const { return values_.data() + offset(y); }

  /// From one row to the next.
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(stride_); }

 private:
  std::size_t offset(int y) const { return static_cast<std::size_t>(y + 1) * stride_ + 1; }

  std::size_t stride_ = 0;
  std::vector<float> values_;
};

/// The pixels of one row that hold liquid lie in [first, last).
struct RowSpan {
  int first = 0;
  int last = 0;

  int width() const { return last - first; }
};

}  // namespace sluice::render
