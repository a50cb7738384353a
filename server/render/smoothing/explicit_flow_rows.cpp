#include "smoothing/explicit_flow_rows.h"

#include <algorithm>
#include <cmath>

#include "simd.h"

namespace sluice::render {

namespace {

/// 1 where |z − z_j| ≤ edge, as in surface.glsl, else 0. Numbers instead of truth values: products of them become
/// vector code, branches do not.
inline float onOneSurface(float reach, float q, float neighbour) {
  return std::abs(neighbour - q) <= reach * neighbour ? 1.0F : 0.0F;
}

/// q_t = A^{ij} q_ij,  A = ½ (q³/|N|) [I + W Wᵀ − b bᵀ/|N|²],  N = (q_X, q_Y, q − W·∇q),  b = ∇q − W·N_3.
inline float rateAt(const ExplicitFlowRow& row, int i, float perPixel) {
  const float q = row.q[i];
  const float reach = row.edge * q;
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
  const float innerX = hasW * hasE;
  const float innerY = hasN * hasS;
  const float innerAll = innerX * innerY * onOneSurface(reach, q, nw) * onOneSurface(reach, q, ne) *
                         onOneSurface(reach, q, sw) * onOneSurface(reach, q, se);

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
  // 1e-30 keeps 0/0 out where there is no liquid; the cube below makes the rate zero there.
  const float inverse = 1.0F / std::max(gradientX * gradientX + gradientY * gradientY + n3 * n3, 1e-30F);
  const float mobility = 0.5F * perPixel * perPixel * q * q * q * std::sqrt(inverse);
  const float bx = gradientX - wx * n3;
  const float by = gradientY - wy * n3;
  return mobility * (innerX * (1.0F + wx * wx - bx * bx * inverse) * (e - 2.0F * q + w) +
                     innerY * (1.0F + wy * wy - by * by * inverse) * (s - 2.0F * q + n) +
                     innerAll * 0.5F * (wx * wy - bx * by * inverse) * (se - sw - ne + nw));
}

}  // namespace

SLUICE_SIMD_CLONES void flowRates(const ExplicitFlowRow& row, float* __restrict rates) {
  const ExplicitFlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) rates[i] = rateAt(local, i, perPixel);
}

SLUICE_SIMD_CLONES void eulerStep(const ExplicitFlowRow& row, float time, float* __restrict next) {
  const ExplicitFlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) next[i] = local.q[i] + time * rateAt(local, i, perPixel);
}

SLUICE_SIMD_CLONES void rklStep(const ExplicitFlowRow& row, const RklStage& stage, float time, const RklRows& rows) {
  const ExplicitFlowRow local = row;
  const float perPixel = 1.0F / local.pixelSlope;
  const auto ofLast = static_cast<float>(stage.last);
  const auto ofBefore = static_cast<float>(stage.before);
  const float ofRate = time * static_cast<float>(stage.rate);
  const float ofStartRate = time * static_cast<float>(stage.startRate);
  const float* __restrict start = rows.start;
  const float* __restrict startRate = rows.startRate;
  float* __restrict before = rows.before;
#pragma GCC ivdep
  for (int i = local.span.first; i < local.span.last; ++i) {
    const float q0 = start[i];
    before[i] = q0 + ofLast * (local.q[i] - q0) + ofBefore * (before[i] - q0) + ofRate * rateAt(local, i, perPixel) +
                ofStartRate * startRate[i];
  }
}

}  // namespace sluice::render
