#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace sluice::render {

/// Cubic cells over the box around some points; cells are numbered with x fastest.
struct ParticleCells {
  Eigen::Vector3f corner = Eigen::Vector3f::Zero();  ///< Least x, y, z, m.
  float edge = 1;                                    ///< m.
  std::array<int, 3> count{1, 1, 1};                 ///< Along each axis.

  /// Cells of at least `leastEdge`; larger ones where the box would need many more cells than there are points.
  static ParticleCells covering(std::span<const Eigen::Vector3f> points, float leastEdge);

  std::array<int, 3> cellOf(const Eigen::Vector3f& point) const;
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(count[0]) *
               (static_cast<std::size_t>(y) + static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(z));
  }
  std::size_t total() const { return index(0, 0, count[2]); }
};

/// Points sorted by cell, to find those near a place. The order is unique: by cell, and within one as given.
class ParticleGrid {
 public:
  /// `points` are finite; `reach` > 0 is the distance, m, up to which neighbours will be looked for.
  ParticleGrid(std::span<const Eigen::Vector3f> points, float reach);

  /// Places in the sorted order, and what stood there before.
  const std::vector<Eigen::Vector3f>& points() const { return points_; }
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls `action(sorted place)` for every point that may be within reach of `point`, in rising order.
  template <class Action>
  void forEachAround(const Eigen::Vector3f& point, Action&& action) const {
    const auto [x, y, z] = cells_.cellOf(point);
    const int left = x > 0 ? x - 1 : 0;
    const int right = x + 1 < cells_.count[0] ? x + 1 : x;
    for (int k = z > 0 ? z - 1 : 0; k <= z + 1 && k < cells_.count[2]; ++k) {
      for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < cells_.count[1]; ++j) {
        const std::uint32_t last = starts_[cells_.index(right, j, k) + 1];
        for (std::uint32_t i = starts_[cells_.index(left, j, k)]; i < last; ++i) action(i);
      }
    }
  }

 private:
  ParticleCells cells_;
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> order_;
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace sluice::render
