#include "smoothing/flow_rows.h"

#include <algorithm>
#include <cmath>

#include "sluice/core/simd.h"
#include "smoothing/flow_terms.h"

namespace sluice::render {

namespace {

/// What a pixel's neighbours say about the surface through it.
struct LocalFlow {
  float c11, c12, c22;  ///< Δt·A/C²; 0 along an axis that is cut.
  float a11, a22;       ///< The same, cut or not.
  float endX, endY;     ///< kInner, kStarts or kEnds.
  SecondDifferences second;
};

/// With an orientation, or where there is none with A = ½q²·I.
template <bool kIsOriented>
[[gnu::always_inline]] inline LocalFlow localFlow(const FlowRow& row, int i, float scale, float perPixel, float edge) {
  const Links has = linksOf(row.surface, i, edge);
  const float facing = scale * row.surface.q[i] * row.surface.q[i];
  FlowTensor a{facing, 0.0F, facing};
  if constexpr (kIsOriented) {
    const float wx = row.firstSlope + row.pixelSlope * static_cast<float>(i);
    a = flowTensor(row.oriented, i, has, wx, row.slope, scale, perPixel);
  }
  LocalFlow flow;
  flow.a11 = a.xx;
  flow.a22 = a.yy;
  flow.endX = has.e - has.w;
  flow.endY = has.s - has.n;
  flow.c11 = has.w * has.e * a.xx;
  flow.c22 = has.n * has.s * a.yy;
  // Kept below both others, the mixed term may stay explicit for any step.
  const float limit = 0.9F * std::min(flow.c11, flow.c22);
  flow.c12 = std::min(std::max(has.corners * a.xy, -limit), limit);
  flow.second = secondDifferences(row.surface, i);
  return flow;
}

enum class Axis { Row, Column };

template <Axis kAxis, bool kIsOriented>
[[gnu::always_inline]] inline void flowAlong(const FlowRow& row, float timeStep, float edge,
                                             float* __restrict coefficient, float* __restrict rightSide,
                                             float* __restrict ends) {
  const FlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) {
    const LocalFlow flow = localFlow<kIsOriented>(local, i, scale, perPixel, edge);
    if constexpr (kAxis == Axis::Row) {
      coefficient[i] = flow.c11;
      rightSide[i] = flow.c11 * flow.second.xx + 0.5F * flow.c12 * flow.second.mixed;
      ends[i] = flow.endX;
    } else {
      coefficient[i] = flow.c22;
      rightSide[i] = flow.c22 * flow.second.yy;
      ends[i] = flow.endY;
    }
  }
}

}  // namespace

SLUICE_SIMD_CLONES void flowAlongRow(const FlowRow& row, float timeStep, float edge, float* __restrict coefficient,
                                     float* __restrict rightSide, float* __restrict ends) {
  if (row.oriented.q == nullptr) {
    flowAlong<Axis::Row, false>(row, timeStep, edge, coefficient, rightSide, ends);
  } else {
    flowAlong<Axis::Row, true>(row, timeStep, edge, coefficient, rightSide, ends);
  }
}

SLUICE_SIMD_CLONES void flowAlongColumn(const FlowRow& row, float timeStep, float edge, float* __restrict coefficient,
                                        float* __restrict rightSide, float* __restrict ends) {
  if (row.oriented.q == nullptr) {
    flowAlong<Axis::Column, false>(row, timeStep, edge, coefficient, rightSide, ends);
  } else {
    flowAlong<Axis::Column, true>(row, timeStep, edge, coefficient, rightSide, ends);
  }
}

Mobility mobilityAt(const FlowRow& row, int i, float timeStep, float edge) {
  const float perPixel = 1.0F / row.pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
  const LocalFlow flow = row.oriented.q == nullptr ? localFlow<false>(row, i, scale, perPixel, edge)
                                                   : localFlow<true>(row, i, scale, perPixel, edge);
  return {flow.a11, flow.a22};
}

EndLink linkEnd(const float* q, std::ptrdiff_t step, float mobility, float edge, int most) {
  int reach = 0;
  while (reach < most) {
    const float inner = q[(reach + 1) * step];
    if (onOneSurface(edge * inner, inner, q[(reach + 2) * step]) == 0.0F) break;
    ++reach;
  }
  if (reach < kLeastEndReach) return {};
  const float slope = (q[(reach + 1) * step] - q[step]) / static_cast<float>(reach);
  const float coefficient = std::min(mobility, kLargestEndLink);
  return {coefficient, coefficient * (q[step] - q[0] - slope)};
}

SLUICE_SIMD_CLONES void markGaps(const float* __restrict q, const float* __restrict neighbour, float edge,
                                 float* __restrict marks, RowSpan span) {
#pragma GCC ivdep
  for (int i = span.first; i < span.last; ++i) {
    marks[i] = q[i] - neighbour[i] > edge * q[i] * neighbour[i] ? 1.0F : 0.0F;
  }
}

void closeGap(float* q, std::ptrdiff_t step, int widest, float edge) {
  for (int n = 1; n <= widest + 1; ++n) {
    const float next = q[n * step];
    if (onOneSurface(edge * q[0], q[0], next) != 0.0F) {
      const float slope = (next - q[0]) / static_cast<float>(n);
      for (int i = 1; i < n; ++i) q[i * step] = q[0] + slope * static_cast<float>(i);
      return;
    }
    if (next > q[0]) return;
  }
}

SLUICE_SIMD_CLONES void widen(DepthRange& range, const float* __restrict q, RowSpan span) {
  DepthRange found = range;
  for (int i = span.first; i < span.last; ++i) {
    found.least = std::min(found.least, q[i] > 0.0F ? q[i] : found.least);
    found.largest = std::max(found.largest, q[i]);
  }
  range = found;
}

SLUICE_SIMD_CLONES void addChange(float* __restrict q, const float* __restrict change, RowSpan span,
                                  const DepthRange& range) {
  const DepthRange limits = range;
#pragma GCC ivdep
  for (int i = span.first; i < span.last; ++i) {
    const float moved = std::min(std::max(q[i] + change[i], limits.least), limits.largest);
    q[i] = std::min(std::max(moved, 0.5F * q[i]), 2.0F * q[i]);
  }
}

SLUICE_SIMD_CLONES void solveInterleavedRows(const float* __restrict before, float* __restrict after,
                                             float* __restrict rightSide, int count) {
  float eliminated[kLanes] = {};
  float known[kLanes] = {};
  for (int i = 0; i < count; ++i) {
    const float* const b = before + i * kLanes;
    float* const a = after + i * kLanes;
    float* const r = rightSide + i * kLanes;
    for (int l = 0; l < kLanes; ++l) {
      const float scale = 1.0F / (1.0F + a[l] + b[l] * (1.0F - eliminated[l]));
      known[l] = (r[l] + b[l] * known[l]) * scale;
      eliminated[l] = a[l] * scale;
      a[l] = eliminated[l];
      r[l] = known[l];
    }
  }
  float x[kLanes] = {};
  for (int i = count - 1; i >= 0; --i) {
    for (int l = 0; l < kLanes; ++l) {
      x[l] = rightSide[i * kLanes + l] + after[i * kLanes + l] * x[l];
      rightSide[i * kLanes + l] = x[l];
    }
  }
}

SLUICE_SIMD_CLONES void eliminateDown(const float* __restrict afterAbove, const float* __restrict rightSideAbove,
                                      const float* __restrict before, float* __restrict after,
                                      float* __restrict rightSide, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    const float scale = 1.0F / (1.0F + after[i] + before[i] * (1.0F - afterAbove[i]));
    rightSide[i] = (rightSide[i] + before[i] * rightSideAbove[i]) * scale;
    after[i] *= scale;
  }
}

SLUICE_SIMD_CLONES void substituteUp(const float* __restrict after, float* __restrict rightSide,
                                     const float* __restrict xBelow, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) rightSide[i] += after[i] * xBelow[i];
}

}  // namespace sluice::render
