#include "metrics/mask.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sluice/core/check.h"

namespace sluice::evaluate {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The set pixels that have a neighbour which is not.
Mask outline(const Mask& mask) {
  const auto [width, height] = mask.size;
  Mask result(mask.size);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!mask.at(x, y)) continue;
      const bool inside = (x == 0 || mask.at(x - 1, y)) && (x == width - 1 || mask.at(x + 1, y)) &&
                          (y == 0 || mask.at(x, y - 1)) && (y == height - 1 || mask.at(x, y + 1));
      result.set[mask.index(x, y)] = inside ? 0 : 1;
    }
  }
  return result;
}

/// The lower envelope of parabolas (p − q)² + f(q), at every p, in place: one line of the distance transform.
class LineTransform {
 public:
  explicit LineTransform(std::size_t longest) : values_(longest), apexes_(longest), starts_(longest + 1) {}

  void run(double* first, std::size_t count, std::size_t stride) {
    for (std::size_t i = 0; i < count; ++i) values_[i] = first[i * stride];
    std::size_t parabolas = 0;
    for (std::size_t q = 0; q < count; ++q) {
      if (values_[q] == kInfinite) continue;
      double start = -kInfinite;
      while (parabolas > 0) {
        start = meeting(q, apexes_[parabolas - 1]);
        if (start > starts_[parabolas - 1]) break;
        --parabolas;
        start = -kInfinite;
      }
      apexes_[parabolas] = q;
      starts_[parabolas] = start;
      ++parabolas;
    }
    if (parabolas == 0) return;
    std::size_t k = 0;
    for (std::size_t p = 0; p < count; ++p) {
      const auto at = static_cast<double>(p);
      while (k + 1 < parabolas && starts_[k + 1] < at) ++k;
      const double away = at - static_cast<double>(apexes_[k]);
      first[p * stride] = away * away + values_[apexes_[k]];
    }
  }

 private:
  /// Where the parabola of a later apex falls below that of an earlier one.
  double meeting(std::size_t later, std::size_t earlier) const {
    const auto a = static_cast<double>(later);
    const auto b = static_cast<double>(earlier);
    return (values_[later] + a * a - values_[earlier] - b * b) / (2 * (a - b));
  }

  std::vector<double> values_;
  std::vector<std::size_t> apexes_;
  std::vector<double> starts_;
};

/// The largest distance from a pixel of `from` to the set that `squaredDistance` was made of.
double farthest(const Mask& from, const std::vector<double>& squaredDistance) {
  double largest = 0;
  for (std::size_t i = 0; i < from.set.size(); ++i) {
    if (from.set[i] != 0) largest = std::max(largest, squaredDistance[i]);
  }
  return std::sqrt(largest);
}

}  // namespace

std::size_t Mask::count() const {
  return static_cast<std::size_t>(std::count_if(set.begin(), set.end(), [](std::uint8_t v) { return v != 0; }));
}

Mask eroded(const Mask& mask, int pixels) {
  Mask result = mask;
  const auto [width, height] = mask.size;
  for (int step = 0; step < pixels; ++step) {
    const Mask before = result;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool inside = x > 0 && x < width - 1 && y > 0 && y < height - 1;
        const bool kept = inside && before.at(x - 1, y) && before.at(x + 1, y) && before.at(x, y - 1) &&
                          before.at(x, y + 1) && before.at(x, y);
        result.set[result.index(x, y)] = kept ? 1 : 0;
      }
    }
  }
  return result;
}

Mask enlarged(const Mask& mask, int factor, core::ImageSize size) {
  Mask result(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const int fromX = std::min(x / factor, mask.size.width - 1);
      const int fromY = std::min(y / factor, mask.size.height - 1);
      result.set[result.index(x, y)] = mask.set[mask.index(fromX, fromY)];
    }
  }
  return result;
}

double intersectionOverUnion(const Mask& a, const Mask& b) {
  SLUICE_CHECK(a.size == b.size);
  std::size_t both = 0;
  std::size_t either = 0;
  for (std::size_t i = 0; i < a.set.size(); ++i) {
    both += a.set[i] != 0 && b.set[i] != 0 ? 1 : 0;
    either += a.set[i] != 0 || b.set[i] != 0 ? 1 : 0;
  }
  return either == 0 ? 1.0 : static_cast<double>(both) / static_cast<double>(either);
}

double hausdorffDistance(const Mask& a, const Mask& b) {
  SLUICE_CHECK(a.size == b.size);
  const Mask outlineA = outline(a);
  const Mask outlineB = outline(b);
  const std::size_t countA = outlineA.count();
  const std::size_t countB = outlineB.count();
  if (countA == 0 && countB == 0) return 0;
  if (countA == 0 || countB == 0) return std::hypot(a.size.width, a.size.height);
  return std::max(farthest(outlineA, squaredDistanceTo(outlineB)), farthest(outlineB, squaredDistanceTo(outlineA)));
}

std::vector<double> squaredDistanceTo(const Mask& mask) {
  const auto width = static_cast<std::size_t>(mask.size.width);
  const auto height = static_cast<std::size_t>(mask.size.height);
  std::vector<double> field(mask.set.size());
  std::ranges::transform(mask.set, field.begin(), [](std::uint8_t v) { return v != 0 ? 0.0 : kInfinite; });
  LineTransform line(std::max(width, height));
  for (std::size_t x = 0; x < width; ++x) line.run(field.data() + x, height, width);
  for (std::size_t y = 0; y < height; ++y) line.run(field.data() + y * width, width, 1);
  return field;
}

}  // namespace sluice::evaluate
