#include "smoothing/flow_rows.h"

#include <algorithm>
#include <cmath>

#include "simd.h"

namespace sluice::render {

namespace {

/// What a pixel's neighbours say about the surface through it.
struct LocalFlow {
  float c11, c12, c22;  ///< Δt·A/C²; 0 along an axis that is cut.
  float a11, a22;       ///< The same, cut or not.
  float endX, endY;     ///< kInner, kStarts or kEnds.
  float xx, mixed, yy;  ///< Second differences of q; `mixed` is four times q_xy.
};

/// 1 where |z − z_j| ≤ edge, as in surface.glsl, else 0. No liquid, 0, is on no surface but that of no liquid. Numbers
/// instead of truth values: products of them become vector code, branches do not.
[[gnu::always_inline]] inline float onOneSurface(float reach, float q, float neighbour) {
  return std::abs(neighbour - q) <= reach * neighbour ? 1.0F : 0.0F;
}

/// Links between a pixel and its neighbours, as numbers.
struct Links {
  float w, e, n, s, corners;
};

[[gnu::always_inline]] inline Links linksOf(const RowAndNeighbours& rows, int i, float edge) {
  const float q = rows.q[i];
  const float reach = edge * q;
  return {onOneSurface(reach, q, rows.q[i - 1]), onOneSurface(reach, q, rows.q[i + 1]),
          onOneSurface(reach, q, rows.above[i]), onOneSurface(reach, q, rows.below[i]),
          onOneSurface(reach, q, rows.above[i - 1]) * onOneSurface(reach, q, rows.above[i + 1]) *
              onOneSurface(reach, q, rows.below[i - 1]) * onOneSurface(reach, q, rows.below[i + 1])};
}

/// Second differences, and what the links say, for any mobility.
[[gnu::always_inline]] inline LocalFlow linkedFlow(const RowAndNeighbours& rows, int i, const Links& has, float a11,
                                                   float a12, float a22) {
  LocalFlow flow;
  flow.a11 = a11;
  flow.a22 = a22;
  flow.endX = has.e - has.w;
  flow.endY = has.s - has.n;
  flow.c11 = has.w * has.e * a11;
  flow.c22 = has.n * has.s * a22;
  // Kept below both others, the mixed term may stay explicit for any step.
  const float limit = 0.9F * std::min(flow.c11, flow.c22);
  flow.c12 = std::min(std::max(has.corners * a12, -limit), limit);
  flow.xx = rows.q[i + 1] - 2.0F * rows.q[i] + rows.q[i - 1];
  flow.yy = rows.below[i] - 2.0F * rows.q[i] + rows.above[i];
  flow.mixed = rows.below[i + 1] - rows.below[i - 1] - rows.above[i + 1] + rows.above[i - 1];
  return flow;
}

/// A = ½ (q³/|N|) [I + W Wᵀ − b bᵀ/|N|²],  N = (q_X, q_Y, q − W·∇q),  b = ∇q − W·N_3.
[[gnu::always_inline]] inline LocalFlow localFlow(const FlowRow& row, int i, float scale, float perPixel, float edge) {
  const Links has = linksOf(row.surface, i, edge);
  const float q = row.oriented.q[i];
  // Slopes with ghost values 2q − q_opposite across a silhouette, and q where both neighbours are gone.
  const float stepW = has.w * (q - row.oriented.q[i - 1]);
  const float stepE = has.e * (row.oriented.q[i + 1] - q);
  const float stepN = has.n * (q - row.oriented.above[i]);
  const float stepS = has.s * (row.oriented.below[i] - q);
  const float forwardX = stepE + (1.0F - has.e) * stepW;
  const float backwardX = stepW + (1.0F - has.w) * stepE;
  const float forwardY = stepS + (1.0F - has.s) * stepN;
  const float backwardY = stepN + (1.0F - has.n) * stepS;
  const float gradientX = 0.5F * perPixel * (forwardX + backwardX);
  const float gradientY = 0.5F * perPixel * (forwardY + backwardY);

  const float wx = row.firstSlope + row.pixelSlope * static_cast<float>(i);
  const float wy = row.slope;
  const float n3 = q - wx * gradientX - wy * gradientY;
  // 1e-30 keeps 0/0 out where there is no liquid; the cube below makes A zero there.
  const float inverse = 1.0F / std::max(gradientX * gradientX + gradientY * gradientY + n3 * n3, 1e-30F);
  const float mobility = scale * q * q * q * std::sqrt(inverse);
  const float bx = gradientX - wx * n3;
  const float by = gradientY - wy * n3;
  return linkedFlow(row.surface, i, has, mobility * (1.0F + wx * wx - bx * bx * inverse),
                    mobility * (wx * wy - bx * by * inverse), mobility * (1.0F + wy * wy - by * by * inverse));
}

/// The same with A = ½q²·I.
[[gnu::always_inline]] inline LocalFlow facingFlow(const FlowRow& row, int i, float scale, float edge) {
  const float q = row.surface.q[i];
  const float mobility = scale * q * q;
  return linkedFlow(row.surface, i, linksOf(row.surface, i, edge), mobility, 0.0F, mobility);
}

}  // namespace

SLUICE_SIMD_CLONES void flowAlongRow(const FlowRow& row, float timeStep, float edge, float* __restrict coefficient,
                                     float* __restrict rightSide, float* __restrict ends) {
  const FlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
  if (local.oriented.q == nullptr) {
#pragma GCC ivdep
    for (int i = local.span.first; i < local.span.last; ++i) {
      const LocalFlow flow = facingFlow(local, i, scale, edge);
      coefficient[i] = flow.c11;
      rightSide[i] = flow.c11 * flow.xx;
      ends[i] = flow.endX;
    }
    return;
  }
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) {
    const LocalFlow flow = localFlow(local, i, scale, perPixel, edge);
    coefficient[i] = flow.c11;
    rightSide[i] = flow.c11 * flow.xx + 0.5F * flow.c12 * flow.mixed;
    ends[i] = flow.endX;
  }
}

SLUICE_SIMD_CLONES void flowAlongColumn(const FlowRow& row, float timeStep, float edge, float* __restrict coefficient,
                                        float* __restrict rightSide, float* __restrict ends) {
  const FlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
  if (local.oriented.q == nullptr) {
#pragma GCC ivdep
    for (int i = local.span.first; i < local.span.last; ++i) {
      const LocalFlow flow = facingFlow(local, i, scale, edge);
      coefficient[i] = flow.c22;
      rightSide[i] = flow.c22 * flow.yy;
      ends[i] = flow.endY;
    }
    return;
  }
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) {
    const LocalFlow flow = localFlow(local, i, scale, perPixel, edge);
    coefficient[i] = flow.c22;
    rightSide[i] = flow.c22 * flow.yy;
    ends[i] = flow.endY;
  }
}

Mobility mobilityAt(const FlowRow& row, int i, float timeStep, float edge) {
  const float perPixel = 1.0F / row.pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
  const LocalFlow flow =
      row.oriented.q == nullptr ? facingFlow(row, i, scale, edge) : localFlow(row, i, scale, perPixel, edge);
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
