#include "smoothing/explicit_flow_rows.h"

#include <algorithm>
#include <cmath>

#include "sluice/core/simd.h"
#include "smoothing/flow_terms.h"

namespace sluice::render {

namespace {

/// q_t = A^{ij} q_ij,  A = ½ (q³/|N|) [I + W Wᵀ − b bᵀ/|N|²].
[[gnu::always_inline]] inline float rateAt(const ExplicitFlowRow& row, int i, float perPixel) {
  const RowAndNeighbours rows{row.above, row.q, row.below};
  const Links has = linksOf(rows, i, row.edge);
  const float wx = row.firstSlope + row.pixelSlope * static_cast<float>(i);
  const FlowTensor a = flowTensor(rows, i, has, wx, row.slope, 0.5F * perPixel * perPixel, perPixel);
  const SecondDifferences second = secondDifferences(rows, i);
  const float innerX = has.w * has.e;
  const float innerY = has.n * has.s;
  return innerX * a.xx * second.xx + innerY * a.yy * second.yy +
         innerX * innerY * has.corners * 0.5F * a.xy * second.mixed;
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
