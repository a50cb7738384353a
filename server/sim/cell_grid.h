#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "particles.h"
#include "team.h"

namespace sluice::sim {

/// Cubic cells that cover a box whose lower corner is the origin; cells are numbered with x fastest, so that the three
/// cells x-1, x, x+1 of a row are one contiguous range.
struct CellGeometry {
  float inverseEdge = 1;  ///< 1/m.
  std::array<std::uint32_t, 3> cells{1, 1, 1};
  std::array<bool, 3> periodic{};  ///< Axes along which the first cells are the last ones' neighbours.

  /// Cells with an edge of at least `support`, at most `cellLimit` of them: where a box would need more, the edge is
  /// made larger, which keeps every search right and makes it slower. Along periodic axes the last cell is up to twice
  /// as long, because the cells must end where the box does.
  static CellGeometry covering(const std::array<double, 3>& size, double support, std::uint64_t cellLimit,
                               const std::array<bool, 3>& periodic = {});

  std::size_t count() const { return std::size_t{cells[0]} * cells[1] * cells[2]; }

  /// Points outside the box belong to the nearest cell.
  std::uint32_t cellOf(const Float4& p) const {
    return coordinate(p.x, 0) + cells[0] * (coordinate(p.y, 1) + cells[1] * coordinate(p.z, 2));
  }

  std::uint32_t coordinate(float position, int axis) const {
    const float scaled = position * inverseEdge;
    if (!(scaled > 0)) return 0;
    const std::uint32_t last = cells[axis] - 1;
    return scaled >= static_cast<float>(last) ? last : static_cast<std::uint32_t>(scaled);
  }
};

/// Counting sort of points by cell (Ihmsen et al. 2011 call it index sort). The order is stable and therefore unique:
/// by cell, and within a cell as before.
class CellGrid {
 public:
  CellGrid() = default;
  explicit CellGrid(const CellGeometry& geometry) : geometry_(geometry), starts_(geometry.count() + 1) {}

  const CellGeometry& geometry() const { return geometry_; }

  /// Sorts; afterwards order()[k] is the present index of the point that comes k-th.
  void sort(const std::vector<Float4>& points, const Team& team);

  /// Takes points as sorted already, the k-th in cell `cells[k]`. Returns false, and is of no use, where they are not
  /// in order or a cell does not exist.
  bool restore(const std::vector<std::uint32_t>& cells);

  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Cell of the k-th point in the new order.
  const std::vector<std::uint32_t>& cellOfSorted() const { return cellOfSorted_; }

  /// Points [starts()[c], starts()[c + 1]) of the new order lie in cell c.
  const std::vector<std::uint32_t>& starts() const { return starts_; }

  struct Range {
    std::uint32_t first;
    std::uint32_t last;
    std::array<std::int8_t, 3> image;  ///< Periods to move its points by; 0 where the box is not periodic.
  };

  /// The points that may lie within one cell edge of a point in `cell`: up to nine contiguous ranges, or each of 27
  /// cells in a periodic box.
  struct Neighbourhood {
    std::array<Range, 27> ranges;
    int count = 0;
    std::size_t points = 0;
  };
  Neighbourhood around(std::uint32_t cell) const;

 private:
  void countStarts();
  Neighbourhood aroundPeriodic(const std::array<std::uint32_t, 3>& place) const;

  CellGeometry geometry_;
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> cell_;
  std::vector<std::uint32_t> cellOfSorted_;
  std::vector<std::uint32_t> order_;
};

}  // namespace sluice::sim
