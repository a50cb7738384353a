#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light_rows.h"
#include "light_view.h"

namespace sluice::render {

/// What focused light is worked out from, all on one grid.
struct CausticsInput {
  std::span<const float> front;         ///< Depth of the smoothed surface along the light, m, or kNoLiquid.
  std::span<const float> inverseIndex;  ///< 1/n of the liquid in front; 1 where it turns no light.
  /// Depth of what the light falls on where that is above the floor, m; or empty. A ray takes the one of its own cell.
  std::span<const float> receiver;
  float limit = 0;        ///< Step between cells that ends a surface, m.
  float floorHeight = 0;  ///< m.
};

/// Where sunlight goes that a liquid's surface has refracted: from every cell of a grid twice as fine a ray is turned
/// by Snell's law and followed to what it falls on, where the cell's flux is laid down. Light is neither lost nor won,
/// but for rays that leave the grid. A ray that leaves the liquid goes on as it went inside: what its back surface does
/// is left out. Uses the OpenMP team of the calling thread; the result is the same for any number of threads.
class Caustics {
 public:
  /// Sunlight on the cells of refined(grid) over what would be there without the liquid, mean 1 and ≥ 0.
  std::span<const float> focus(const CausticsInput& input, const LightGrid& grid);

 private:
  void trace(const CausticsInput& input, const LightGrid& grid);
  RayRow rays(const CausticsInput& input, const LightGrid& grid, int y, int sideX, int sideY) const;
  void land(const LightGrid& fine);
  void blur(const LightGrid& fine);

  std::vector<float> slopeX_;
  std::vector<float> slopeY_;
  /// Where rays land, cells of the fine grid: line 4y + k is the k-th ray of every cell of row y.
  std::vector<float> u_;
  std::vector<float> v_;
  std::vector<std::int16_t> firstRow_;  ///< Of the fine grid, that a line's rays land in, and last.
  std::vector<std::int16_t> lastRow_;
  std::vector<float> flux_;
  std::vector<float> scratch_;
};

}  // namespace sluice::render
