#pragma once

#include "smoothing/implicit_curvature_flow.h"
#include "smoothing/smoothing_method.h"

namespace sluice::render {

/// ImplicitCurvatureFlow on the device, by implicit_curvature_flow.comp: for GPUs. Lives on the thread of the context.
///
/// The links of all pixels are found at once; lines are then solved one a thread. Draws into all of kSurfaceScratch.
class ImplicitFlowShaders {
 public:
  ImplicitFlowShaders();

  /// Smooths Resource::Surface in place.
  void run(const FrameContext& frame, const FlowSettings& settings);

 private:
  enum class Axis { Rows, Columns };

  void solve(const FrameContext& frame, Resource picture, const Resource* oriented, Axis axis, float time) const;
  void closeGaps(const FrameContext& frame, int dx, int dy) const;
  void findRange(const FrameContext& frame);

  gl::Program range_;
  gl::Program closeGaps_;
  gl::Program link_;
  gl::Program solve_;
  gl::StreamBuffer rangeBuffer_;
};

}  // namespace sluice::render
