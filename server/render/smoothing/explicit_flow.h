#pragma once

#include <span>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/render/frame_plan.h"
#include "smoothing/explicit_flow_rows.h"

namespace sluice::render {

/// What explicit flow needs to know of a picture of inverse depths.
struct ExplicitFlowSettings {
  float pixelSlope = 1e-3F;  ///< C.
  float edge = 1;            ///< Step of eye depth between neighbouring pixels that counts as a silhouette, m.
};

/// Explicit mean curvature flow on the CPU, for devices whose shaders run there too: the same steps as
/// curvature_flow.frag and rkl_curvature_flow.frag, several times as fast. Uses the OpenMP team of the calling thread;
/// the result is the same for any number of threads.
class ExplicitFlow {
 public:
  /// Smooths in place: `q` holds one inverse depth per pixel, row by row, 0 where there is no liquid, which stays so.
  /// Forward Euler where the schedule's steps have one stage, else RKL2.
  void run(std::span<float> q, core::ImageSize size, const ExplicitFlowSettings& settings,
           const FlowSchedule& schedule);

 private:
  ExplicitFlowRow rowOf(const PaddedField& picture, int y) const;
  PaddedField* runEuler(const FlowSchedule& schedule);
  PaddedField* runRkl(const FlowSchedule& schedule);

  core::ImageSize size_;
  ExplicitFlowSettings settings_;
  std::vector<RowSpan> spans_;  ///< The liquid of every row.
  PaddedField picture_;
  PaddedField other_;  ///< The picture after the next step, or the one before the last stage.
  PaddedField start_;
  PaddedField startRate_;
};

}  // namespace sluice::render
