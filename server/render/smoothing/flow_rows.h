#pragma once

#include <cstddef>

#include "smoothing/padded_field.h"

namespace sluice::render {

/// One row of inverse depths with the rows around it.
struct RowAndNeighbours {
  const float* above;
  const float* q;
  const float* below;
};

/// What the flow reads to move one row.
struct FlowRow {
  RowAndNeighbours surface;
  RowAndNeighbours oriented;  ///< The same surface, smooth enough to tell its slope. Null where only q spreads.
  RowSpan span;
  float firstSlope;  ///< W_x of pixel 0.
  float slope;       ///< W_y.
  float pixelSlope;  ///< C.
};

/// Which neighbours along the axis at hand are on a pixel's surface, as a number.
constexpr float kInner = 0.0F;   ///< Both, or neither.
constexpr float kStarts = 1.0F;  ///< A line of the surface starts here: only the one after.
constexpr float kEnds = -1.0F;   ///< A line ends here: only the one before.

/// Without an orientation A is ½q²·I, that of a surface that faces the eye.
///
/// Coefficients c = Δt·A^{xx}/C² of one row and the right-hand side c·(second difference of q along x) plus the mixed
/// term, for pixels inside a line; both are 0 at pixels where a neighbour along x is not on the surface, which `ends`
/// tells.
void flowAlongRow(const FlowRow& row, float timeStep, float edge, float* coefficient, float* rightSide, float* ends);

/// The same along y: c = Δt·A^{yy}/C², without the mixed term.
void flowAlongColumn(const FlowRow& row, float timeStep, float edge, float* coefficient, float* rightSide, float* ends);

/// Least pixels along which the slope at the end of a line is taken; with one alone both ends of a short line chase
/// each other.
constexpr int kLeastEndReach = 2;

/// Of the mobility at an end, at most this much counts: the neighbour inside then weighs as much as the end itself.
/// More would let lines drift when the step is very long: with 1 noise on a line of any length grows by a quarter at
/// most.
constexpr float kLargestEndLink = 1.0F;

/// How the end of a line moves: with the slope that the surface has inside, q tends to what that slope makes of the
/// neighbour. A plane's end stays where it is.
struct EndLink {
  float coefficient = 0;  ///< To the neighbour inside; 0 where the line is too short to tell its slope.
  float rightSide = 0;
};

/// `mobility` is Δt·A/C² at the end; q, the inverse depths along the line, `step` apart in memory, begins there. At
/// most 1 of the mobility counts: the neighbour then weighs as much as the end itself, which keeps lines from drifting
/// away however long the step is. The slope is taken over `reach` pixels where the line is that long: about a particle
/// spacing, or it would be that of a single splat's limb.
EndLink linkEnd(const float* q, std::ptrdiff_t step, float mobility, float edge, int reach);

/// Δt·A^{xx}/C² and Δt·A^{yy}/C² at one pixel, whatever its neighbours.
struct Mobility {
  float alongX, alongY;
};
Mobility mobilityAt(const FlowRow& row, int i, float timeStep, float edge);

/// Pixels in `span` where a line starts or ends, in order.
template <class Action>
void forEachEnd(const float* ends, RowSpan span, Action&& action) {
  constexpr int kBlock = 32;
  for (int first = span.first; first < span.last; first += kBlock) {
    const int last = first + kBlock < span.last ? first + kBlock : span.last;
    float any = 0.0F;
    for (int i = first; i < last; ++i) any += ends[i] * ends[i];
    if (any == 0.0F) continue;
    for (int i = first; i < last; ++i) {
      if (ends[i] != kInner) action(i, ends[i]);
    }
  }
}

/// Marks with 1, else 0, the pixels whose neighbour along the axis, given as a row of its own, lies behind on another
/// surface or is background.
void markGaps(const float* q, const float* neighbour, float edge, float* marks, RowSpan span);

/// Closes the gap after q, if there is one: where the surface comes back after at most `widest` pixels, `step` apart in
/// memory, and all between lies behind it or is background, those pixels are put onto it. The line has to reach
/// `widest` + 1 pixels beyond q.
void closeGap(float* q, std::ptrdiff_t step, int widest, float edge);

/// The inverse depths of a picture's liquid lie in [least, largest].
struct DepthRange {
  float least;
  float largest;
};

/// Takes the liquid of one row into the range.
void widen(DepthRange& range, const float* q, RowSpan span);

/// q += change in one row, at most by a factor of two, and never out of the range of the whole surface: curvature flow
/// makes no new extremes, but the mixed term, which alone is explicit, and the ends of lines may ask for them.
void addChange(float* q, const float* change, RowSpan span, const DepthRange& range);

/// Solves (1 + b_i + a_i) x_i − b_i x_{i−1} − a_i x_{i+1} = r_i, b linking to the pixel before and a to the one after,
/// for kLanes rows at once, in place of r. Element i of lane l is at [i·kLanes + l]; beyond the ends x is 0.
constexpr int kLanes = 16;
void solveInterleavedRows(const float* before, float* after, float* rightSide, int count);

/// One row of the elimination down the columns: turns `after`, the links to the row below, and r into the eliminated
/// ones, given those of the row above.
void eliminateDown(const float* afterAbove, const float* rightSideAbove, const float* before, float* after,
                   float* rightSide, int first, int last);

/// One row of the substitution up the columns: r becomes x, given x of the row below.
void substituteUp(const float* after, float* rightSide, const float* xBelow, int first, int last);

}  // namespace sluice::render
