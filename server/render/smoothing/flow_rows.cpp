#include "smoothing/flow_rows.h"

#include <algorithm>
#include <cmath>

#include "simd.h"

namespace sluice::render {

namespace {

/// What a pixel's neighbours say about the surface through it.
struct LocalFlow {
  float c11, c12, c22;  ///< Δt·A/C²; 0 along an axis that is cut.
  float xx, mixed, yy;  ///< Second differences of q; `mixed` is four times q_xy.
};

/// 1 where |z − z_j| ≤ edge, as in surface.glsl, else 0. No liquid, 0, is on no surface but that of no liquid. Numbers
/// instead of truth values: products of them become vector code, branches do not.
inline float onOneSurface(float reach, float q, float neighbour) {
  return std::abs(neighbour - q) <= reach * neighbour ? 1.0F : 0.0F;
}

/// A = ½ (q³/|N|) [I + W Wᵀ − b bᵀ/|N|²],  N = (q_X, q_Y, q − W·∇q),  b = ∇q − W·N_3.
inline LocalFlow localFlow(const FlowRow& row, int i, float scale, float perPixel, float edge) {
  const float q = row.q[i];
  const float reach = edge * q;
  const float w = row.q[i - 1];
  const float e = row.q[i + 1];
  const float n = row.above[i];
  const float s = row.below[i];
  const float nw = row.above[i - 1];
  const float ne = row.above[i + 1];
  const float sw = row.below[i - 1];
  const float se = row.below[i + 1];
  const float hasW = onOneSurface(reach, q, w);
  const float hasE = onOneSurface(reach, q, e);
  const float hasN = onOneSurface(reach, q, n);
  const float hasS = onOneSurface(reach, q, s);
  const float hasCorners =
      onOneSurface(reach, q, nw) * onOneSurface(reach, q, ne) * onOneSurface(reach, q, sw) * onOneSurface(reach, q, se);

  // Slopes with ghost values 2q − q_opposite across a silhouette, and q where both neighbours are gone.
  const float stepW = hasW * (q - w);
  const float stepE = hasE * (e - q);
  const float stepN = hasN * (q - n);
  const float stepS = hasS * (s - q);
  const float forwardX = stepE + (1.0F - hasE) * stepW;
  const float backwardX = stepW + (1.0F - hasW) * stepE;
  const float forwardY = stepS + (1.0F - hasS) * stepN;
  const float backwardY = stepN + (1.0F - hasN) * stepS;
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

  const float a11 = mobility * (1.0F + wx * wx - bx * bx * inverse);
  const float a22 = mobility * (1.0F + wy * wy - by * by * inverse);
  const float a12 = mobility * (wx * wy - bx * by * inverse);
  LocalFlow flow;
  flow.c11 = hasW * hasE * a11;
  flow.c22 = hasN * hasS * a22;
  // Kept below both others, the mixed term may stay explicit for any step.
  const float limit = 0.9F * std::min(flow.c11, flow.c22);
  const float c12 = hasCorners * a12;
  flow.c12 = std::min(std::max(c12, -limit), limit);
  flow.xx = e - 2.0F * q + w;
  flow.yy = s - 2.0F * q + n;
  flow.mixed = se - sw - ne + nw;
  return flow;
}

}  // namespace

SLUICE_SIMD_CLONES void flowAlongRow(const FlowRow& row, float timeStep, float edge, float* __restrict coefficient,
                                     float* __restrict rightSide) {
  const FlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) {
    const LocalFlow flow = localFlow(local, i, scale, perPixel, edge);
    coefficient[i] = flow.c11;
    rightSide[i] = flow.c11 * flow.xx + 0.5F * flow.c12 * flow.mixed;
  }
}

SLUICE_SIMD_CLONES void flowAlongColumn(const FlowRow& row, float timeStep, float edge, float* __restrict coefficient,
                                        float* __restrict rightSide) {
  const FlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) {
    const LocalFlow flow = localFlow(local, i, scale, perPixel, edge);
    coefficient[i] = flow.c22;
    rightSide[i] = flow.c22 * flow.yy;
  }
}

SLUICE_SIMD_CLONES void addChange(float* __restrict q, const float* __restrict change, RowSpan span) {
#pragma GCC ivdep
  for (int i = span.first; i < span.last; ++i) q[i] = std::min(std::max(q[i] + change[i], 0.5F * q[i]), 2.0F * q[i]);
}

SLUICE_SIMD_CLONES void solveInterleavedRows(float* __restrict c, float* __restrict b, int count) {
  float eliminated[kLanes] = {};
  float known[kLanes] = {};
  for (int i = 0; i < count; ++i) {
    float* const ci = c + i * kLanes;
    float* const bi = b + i * kLanes;
    for (int l = 0; l < kLanes; ++l) {
      const float scale = 1.0F / (1.0F + ci[l] * (2.0F - eliminated[l]));
      known[l] = (bi[l] + ci[l] * known[l]) * scale;
      eliminated[l] = ci[l] * scale;
      ci[l] = eliminated[l];
      bi[l] = known[l];
    }
  }
  float after[kLanes] = {};
  for (int i = count - 1; i >= 0; --i) {
    for (int l = 0; l < kLanes; ++l) {
      after[l] = b[i * kLanes + l] + c[i * kLanes + l] * after[l];
      b[i * kLanes + l] = after[l];
    }
  }
}

SLUICE_SIMD_CLONES void eliminateDown(const float* __restrict cAbove, const float* __restrict bAbove,
                                      float* __restrict c, float* __restrict b, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    const float scale = 1.0F / (1.0F + c[i] * (2.0F - cAbove[i]));
    b[i] = (b[i] + c[i] * bAbove[i]) * scale;
    c[i] *= scale;
  }
}

SLUICE_SIMD_CLONES void substituteUp(const float* __restrict c, float* __restrict b, const float* __restrict xBelow,
                                     int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) b[i] += c[i] * xBelow[i];
}

}  // namespace sluice::render
