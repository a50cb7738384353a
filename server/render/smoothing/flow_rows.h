#pragma once

#include "smoothing/padded_field.h"

namespace sluice::render {

/// One row of inverse depths with the rows around it, and where its view slopes lie.
struct FlowRow {
  const float* above;
  const float* q;
  const float* below;
  RowSpan span;
  float firstSlope;  ///< W_x of pixel 0.
  float slope;       ///< W_y.
  float pixelSlope;  ///< C.
};

/// Coefficients c = Δt·A^{xx}/C² of one row and the right-hand side c·(second difference of q along x) plus the mixed
/// term. Where a neighbour along x is not on the pixel's surface, both are 0.
void flowAlongRow(const FlowRow& row, float timeStep, float edge, float* coefficient, float* rightSide);

/// The same along y: c = Δt·A^{yy}/C², without the mixed term.
void flowAlongColumn(const FlowRow& row, float timeStep, float edge, float* coefficient, float* rightSide);

/// q += change in one row. A change beyond a factor of two is cut: the mixed term, which alone is explicit, can ask for
/// it next to a cliff.
void addChange(float* q, const float* change, RowSpan span);

/// Solves (1 + 2c_i) x_i − c_i (x_{i−1} + x_{i+1}) = b_i for kLanes rows at once, in place of b. Element i of lane l is
/// at [i·kLanes + l]; beyond the ends x is 0.
constexpr int kLanes = 16;
void solveInterleavedRows(float* c, float* b, int count);

/// One row of the elimination down the columns: turns c and b into the eliminated ones, given those of the row above.
void eliminateDown(const float* cAbove, const float* bAbove, float* c, float* b, int first, int last);

/// One row of the substitution up the columns: b becomes x, given x of the row below.
void substituteUp(const float* c, float* b, const float* xBelow, int first, int last);

}  // namespace sluice::render
