#pragma once

#include <span>
#include <vector>

#include "sluice/core/camera.h"
#include "smoothing/padded_field.h"

namespace sluice::render {

/// What the flow needs to know of a picture of inverse depths.
struct FlowSettings {
  float pixelSlope = 1e-3F;  ///< C.
  float time = 0;            ///< Flow time of all steps together, m².
  float edge = 1;            ///< Step of eye depth between neighbouring pixels that counts as a silhouette, m.
  int steps = 3;
};

/// Mean curvature flow of a surface seen in perspective, q_t = A^{ij}(q)·q_ij (the law of curvature_flow.frag), in a
/// few large implicit steps on the CPU.
///
/// A step is locally one-dimensional backward Euler with lagged coefficients: first along rows, then along columns,
///   (I − Δt·A^{xx}∂_xx) δ = Δt·(A^{xx} q_xx + 2A^{xy} q_xy),  q += δ;  (I − Δt·A^{yy}∂_yy) δ = Δt·A^{yy} q_yy,  q +=
///   δ,
/// each line solved exactly by elimination. A bump of wave numbers k, l shrinks by 1/((1+Δt·A^{xx}k²)(1+Δt·A^{yy}l²)):
/// stable for any Δt. Lines end at silhouettes, where a pixel stays put along the axis that is cut, as the ghost values
/// of the explicit flow have it; nothing is ever smoothed across, which makes grids that are coarser than the picture
/// (multigrid) diverge at silhouettes.
///
/// Runs on the calling thread alone: a step takes a few milliseconds, too short to share out while a simulation has the
/// other cores.
class ImplicitCurvatureFlow {
 public:
  /// Smooths in place: `q` holds one inverse depth per pixel, row by row, 0 where there is no liquid, which stays so.
  void smooth(std::span<float> q, core::ImageSize size, const FlowSettings& settings);

 private:
  /// The part of the picture that holds liquid, with its span in every row.
  struct Window {
    int left = 0;
    int top = 0;
    int width = 0;
    std::vector<RowSpan> spans;

    int height() const { return static_cast<int>(spans.size()); }
  };

  static Window findLiquid(std::span<const float> q, core::ImageSize size);
  void fit(const Window& window);
  void smoothRows(const Window& window, const FlowSettings& settings, core::ImageSize size, float timeStep);
  void smoothColumns(const Window& window, const FlowSettings& settings, core::ImageSize size, float timeStep);

  int width_ = 0;
  int height_ = 0;
  PaddedField picture_;
  PaddedField coefficient_;  ///< c = Δt·A/C² along the axis at hand.
  PaddedField rightSide_;
  std::vector<float> block_;  ///< Interleaved rows while they are solved.
};

}  // namespace sluice::render
