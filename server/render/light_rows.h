#pragma once

#include <cstddef>

namespace sluice::render {

// The inner loops of the light map, compiled for several instruction sets. Rows have the same number of cells.

/// Depth of a cell without liquid, m: farther than anything, and so far from liquid that nothing is exchanged with it.
constexpr float kNoLiquid = 1e30F;

/// One sweep of the mean of three cells along a line, for `count` cells whose neighbours stand `step` before and
/// behind. Cells more than `limit` apart exchange nothing; what the others exchange is the same both ways, so that the
/// sum stays. Adds 2/3 cell² to the variance of what it has smoothed.
void exchangeRow(const float* from, std::ptrdiff_t step, float limit, float* to, int count);

/// The front surface along one row of cells, with the rows around it.
struct FrontRows {
  const float* above;
  const float* front;  ///< Depth along the light, m.
  const float* below;
};

/// ∂z/∂x and ∂z/∂y, from those of a cell's neighbours that are on its surface; 0 where there is no liquid. Reads one
/// cell before and one behind the row.
void slopeRow(const FrontRows& rows, float limit, float inverseCell, float* slopeX, float* slopeY, int count);

/// What the rays of one row of cells meet. Lengths in m; light space, see LightAxes.
struct RayRow {
  FrontRows rows;
  // Of the row itself and of the row beside it, above or below, that its rays lie next to.
  const float* slopeX;
  const float* slopeY;
  const float* besideFront;
  const float* besideSlopeX;
  const float* besideSlopeY;
  const float* inverseIndex;  ///< 1/n of the liquid in front; 1 lets light through as it came.
  const float* receiver;      ///< Depth of what the light falls on above the floor, or null.
  int side;                   ///< -1: the rays lie a quarter of a cell before the cells' middles along x; 1: behind.
  float sideY;                ///< The same along y.
  float y;                    ///< Of the cells' middles.
  float cell;
  float downY, alongY;  ///< World y per light space's y and z.
  float floorHeight;
  float firstU, v;  ///< Where the first ray, and every ray, would land unrefracted, cells of the fine grid.
  float perMetre;   ///< Such cells per m.
  float most;       ///< Farther from there than this, cells, rays need not be told apart.
};

/// Refracts one ray per cell [Snell] and follows it to the receiver: `u` and `v` say where it lands, in cells of the
/// finer grid from its corner, or just outside.
void traceRow(const RayRow& row, float* u, float* v, int count);

/// optical += σ·t along one row; `thickness` in m along the light.
void addOpticalDepth(const float* thickness, float sigma, float* optical, int count);

/// share = e^(−optical depth).
void transmitRow(const float* optical, float* share, int count);

/// result = (1 4 6 4 1)/16 over five lines `step` apart, `line` in the middle.
void blurRow(const float* line, std::ptrdiff_t step, float* result, int count);

/// What one row of the light map is put together from. The coarse rows have half as many cells, and one more before and
/// behind.
struct SunlightRow {
  const float* own[3];     ///< Shares of red, green, blue let through, of the coarse row that holds this one,
  const float* beside[3];  ///< and of the row that it lies next to.
  const float* front;      ///< Of the coarse row.
  const float* focus;      ///< Or null, where nothing is focused.
  float caustics;          ///< Strength.
};

/// Four floats a cell, see LightMap. `coarseCount` is the number of coarse cells.
void sunlightRow(const SunlightRow& row, float* texels, int coarseCount);

}  // namespace sluice::render
