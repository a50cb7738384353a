#pragma once

#include <memory>
#include <span>

#include "sluice/core/camera.h"

namespace sluice::render {

class Multigrid;

/// What the flow needs to know of a picture of inverse depths.
struct FlowSettings {
  float pixelSlope = 1e-3F;  ///< C.
  float time = 0;            ///< Flow time of all steps together, m².
  float edge = 1;            ///< Step of eye depth between neighbouring pixels that counts as a silhouette, m.
  int steps = 2;
  int cycles = 2;  ///< V-cycles per step.
};

/// Mean curvature flow of a surface seen in perspective, q_t = A^{ij}(q)·q_ij (the law of curvature_flow.frag), by
/// backward Euler with the coefficients of the step's start: (I − Δt·A^{ij}∂_ij) δ = Δt·A^{ij}∂_ij q, q += δ. That is
/// stable for any Δt, so that a frame's whole smoothing takes two steps; each is solved by multigrid on the CPU.
/// Runs on the calling thread alone: the sweeps are far too short to share out while a simulation has the other cores.
class ImplicitCurvatureFlow {
 public:
  ImplicitCurvatureFlow();
  ~ImplicitCurvatureFlow();

  /// Smooths in place: `q` holds one inverse depth per pixel, row by row, 0 where there is no liquid, which stays so.
  void smooth(std::span<float> q, core::ImageSize size, const FlowSettings& settings);

 private:
  void fitGrids(int width, int height);

  int width_ = 0;
  int height_ = 0;
  std::unique_ptr<Multigrid> grids_;
};

}  // namespace sluice::render
