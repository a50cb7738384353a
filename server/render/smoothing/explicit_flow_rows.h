#pragma once

#include "smoothing/padded_field.h"
#include "smoothing/rkl_stages.h"

namespace sluice::render {

/// One row of inverse depths with the rows around it, and what the flow needs to know of it.
struct ExplicitFlowRow {
  const float* above;
  const float* q;
  const float* below;
  RowSpan span;
  float firstSlope;  ///< W_x of pixel 0.
  float slope;       ///< W_y.
  float pixelSlope;  ///< C.
  float edge;        ///< Step of eye depth that counts as a silhouette, m.
};

/// The law of shaders/flow_rate.glsl: q_t of every pixel in the span, 1/m³.
void flowRates(const ExplicitFlowRow& row, float* rates);

/// q + `time`·q_t.
void eulerStep(const ExplicitFlowRow& row, float time, float* next);

/// A stage's other rows. `before` holds Y_{j−2} and gets Y_j.
struct RklRows {
  const float* start;
  const float* startRate;
  float* before;
};

/// One stage of a step of `time`; `row` holds Y_{j−1}.
void rklStep(const ExplicitFlowRow& row, const RklStage& stage, float time, const RklRows& rows);

}  // namespace sluice::render
