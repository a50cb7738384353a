#pragma once

#include <cstddef>
#include <vector>

namespace sluice::render {

/// A picture of floats with one pixel of zeros all around, so that filters need no special case at the borders.
class PaddedField {
 public:
  PaddedField() = default;
  PaddedField(int width, int height)
      : stride_(static_cast<std::size_t>(width) + 2), values_(stride_ * (static_cast<std::size_t>(height) + 2)) {}

  /// Pixel 0 of a row; rows -1 and height, and pixels -1 and width, are the padding.
  float* row(int y) { return values_.data() + offset(y); }
  const float* row(int y) const { return values_.data() + offset(y); }

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
