#pragma once

#include <span>
#include <vector>

#include "sluice/core/camera.h"
#include "smoothing/flow_rows.h"

namespace sluice::render {

/// What the flow needs to know of a picture of inverse depths.
struct FlowSettings {
  float pixelSlope = 1e-3F;  ///< C.
  float time = 0;            ///< Flow time of all steps together, m².
  float edge = 1;            ///< Step of eye depth between neighbouring pixels that counts as a silhouette, m.
  float spacing = 0.05F;     ///< d, m.
  float widestGap = 0;       ///< Gaps between splats up to this wide are closed first, m.
  int steps = 3;
};

/// How the steps share the flow time, m².
struct FlowTimes {
  float merging;  ///< In which splats merge in the copy that tells slopes.
  float step;     ///< Each of `steps`.
  float last;     ///< The short one at the end.
};

FlowTimes flowTimes(const FlowSettings& settings);

/// Mean curvature flow of a surface seen in perspective, q_t = A^{ij}(q)·q_ij (the law of curvature_flow.frag), in a
/// few large implicit steps on the CPU.
///
/// A step is locally one-dimensional backward Euler with lagged coefficients: first along rows, then along columns,
///   (I − Δt·A^{xx}∂_xx) δ = Δt·(A^{xx} q_xx + 2A^{xy} q_xy),  q += δ;  (I − Δt·A^{yy}∂_yy) δ = Δt·A^{yy} q_yy,  q +=
///   δ,
/// each line solved exactly by elimination. A bump of wave numbers k, l shrinks by 1/((1+Δt·A^{xx}k²)(1+Δt·A^{yy}l²)):
/// stable for any Δt. Lines end at silhouettes, where a pixel follows its neighbour inside with the slope of the
/// surface there (see linkEnd); nothing is ever smoothed across, which makes grids that are coarser than the picture
/// (multigrid) diverge at silhouettes.
///
/// The mobility A follows the slope of the surface, not that of single splats: the first step takes it from a copy in
/// which splats have merged (as Catté et al. 1992 do for diffusion of images). With the slopes of the splats themselves
/// every limb is a barrier to the lines that cross it, and long steps leave streaks along both axes.
///
/// Before that, narrow gaps in a surface are closed, through which another one far behind shows, or the background:
/// seen at a flat angle splats stand apart, and every gap would end lines that belong together; and silhouettes lose
/// the notches between one splat and the next.
///
/// Uses the OpenMP team of the calling thread; the result is the same for any number of threads.
class ImplicitCurvatureFlow {
 public:
  /// Smooths in place: `q` holds one inverse depth per pixel, row by row, 0 where there is no liquid, which stays so
  /// but for gaps that are closed.
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

  /// One implicit step.
  struct Step {
    float time;                   ///< Flow time, m².
    float pixelSlope;             ///< C.
    float edge;                   ///< As in FlowSettings.
    float spacing;                ///< Likewise.
    core::ImageSize size;         ///< Of the whole picture.
    const PaddedField* oriented;  ///< Where the surface's slope is read; null to let q spread alike everywhere.
  };

  static Window findLiquid(std::span<const float> q, core::ImageSize size);
  /// The pixels of row y that belong to one chunk of columns.
  static RowSpan part(const Window& window, int y, int chunk);
  FlowRow flowRow(const Window& window, int y, RowSpan span, const Step& step) const;
  void fit(const Window& window);
  void closeGaps(Window& window, const FlowSettings& settings);
  void orient(const Window& window, const FlowSettings& settings, core::ImageSize size);
  void smoothRows(const Window& window, const Step& step);
  void smoothColumns(const Window& window, const Step& step);

  int width_ = 0;
  int height_ = 0;
  DepthRange range_;
  PaddedField picture_;
  PaddedField oriented_;
  PaddedField before_;  ///< Links to the pixel before along the axis at hand, Δt·A/C².
  PaddedField after_;   ///< Likewise to the pixel after.
  PaddedField rightSide_;
};

}  // namespace sluice::render
