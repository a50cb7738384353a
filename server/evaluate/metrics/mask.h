#pragma once

#include <cstdint>
#include <vector>

#include "sluice/core/camera.h"

namespace sluice::evaluate {

/// One yes or no per pixel, row by row from the top.
struct Mask {
  core::ImageSize size;
  std::vector<std::uint8_t> set;

  explicit Mask(core::ImageSize s = {})
      : size(s), set(static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height)) {}

  bool at(int x, int y) const { return set[index(x, y)] != 0; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
  }
  std::size_t count() const;
};

/// Without the pixels that are within `pixels` steps along rows and columns of one that is not set, or of the picture's
/// edge.
Mask eroded(const Mask& mask, int pixels);

/// Every pixel repeated `factor` times in both directions, cut to `size`.
Mask enlarged(const Mask& mask, int factor, core::ImageSize size);

/// Pixels set in both over pixels set in either; 1 where there are none.
double intersectionOverUnion(const Mask& a, const Mask& b);

/// The largest distance, pixels, from a point of one mask's outline to the nearest of the other's, whichever way is
/// longer. The outline is made of the set pixels beside one that is not; the picture's edge is none. 0 where neither
/// has one, the picture's diagonal where one has.
double hausdorffDistance(const Mask& a, const Mask& b);

/// Squared distance from every pixel to the nearest that is set, pixels²; exact (Felzenszwalb & Huttenlocher 2012).
/// Infinite where none is set.
std::vector<double> squaredDistanceTo(const Mask& mask);

}  // namespace sluice::evaluate
