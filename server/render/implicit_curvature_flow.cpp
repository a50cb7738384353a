#include "implicit_curvature_flow.h"

#include <algorithm>
#include <cmath>

#include "multigrid.h"
#include "simd.h"
#include "sluice/core/check.h"

namespace sluice::render {

namespace {

/// The part of a picture that holds liquid: columns [first, last), rows [top, bottom).
struct LiquidBounds {
  int first, last, top, bottom;
};

RowSpan liquidSpan(const float* q, int width) {
  int first = 0;
  while (first < width && q[first] <= 0.0F) ++first;
  int last = width;
  while (last > first && q[last - 1] <= 0.0F) --last;
  return {first, last};
}

/// One row of the picture with its neighbours, and where its coefficients go.
struct CoefficientRow {
  const float* above;
  const float* q;
  const float* below;
  float* c11;
  float* c12;
  float* c22;
  float* b;
};

/// Coefficients c = Δt·A/C² and right-hand side of one row. `slopeX` is W_x of pixel 0.
///   A = ½ (q³/|N|) [I + W Wᵀ − b bᵀ/|N|²],  N = (q_X, q_Y, q − W·∇q),  b = ∇q − W·N_3
/// An axis along which a neighbour is not on the same surface gets no diffusion; the mixed term needs all eight.
SLUICE_SIMD_CLONES void coefficientRow(const CoefficientRow& row, int first, int last, float slopeX, float slopeY,
                                       float pixelSlope, float timeStep, float edge) {
  const float* const above = row.above;
  const float* const q = row.q;
  const float* const below = row.below;
  float* const c11 = row.c11;
  float* const c12 = row.c12;
  float* const c22 = row.c22;
  float* const b = row.b;
  const float perPixel = 1.0F / pixelSlope;
  const float scale = 0.5F * timeStep * perPixel * perPixel;
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    const float centre = q[i];
    const float reach = edge * centre;
    const float w = q[i - 1];
    const float e = q[i + 1];
    const float n = above[i];
    const float s = below[i];
    const float nw = above[i - 1];
    const float ne = above[i + 1];
    const float sw = below[i - 1];
    const float se = below[i + 1];
    // |z − z_j| ≤ edge; false for q = 0 on either side.
    const bool hasW = std::abs(w - centre) <= reach * w && w > 0.0F;
    const bool hasE = std::abs(e - centre) <= reach * e && e > 0.0F;
    const bool hasN = std::abs(n - centre) <= reach * n && n > 0.0F;
    const bool hasS = std::abs(s - centre) <= reach * s && s > 0.0F;
    const bool hasCorners = (std::abs(nw - centre) <= reach * nw) & (std::abs(ne - centre) <= reach * ne) &
                            (std::abs(sw - centre) <= reach * sw) & (std::abs(se - centre) <= reach * se) &
                            (std::min(std::min(nw, ne), std::min(sw, se)) > 0.0F);
    // Ghost values 2q − q_opposite across a silhouette, q where both neighbours are gone.
    const float ghostW = hasW ? w : (hasE ? 2.0F * centre - e : centre);
    const float ghostE = hasE ? e : (hasW ? 2.0F * centre - w : centre);
    const float ghostN = hasN ? n : (hasS ? 2.0F * centre - s : centre);
    const float ghostS = hasS ? s : (hasN ? 2.0F * centre - n : centre);

    const float gradientX = 0.5F * perPixel * (ghostE - ghostW);
    const float gradientY = 0.5F * perPixel * (ghostS - ghostN);
    const float wx = slopeX + pixelSlope * static_cast<float>(i);
    const float n3 = centre - wx * gradientX - slopeY * gradientY;
    const float squared = gradientX * gradientX + gradientY * gradientY + n3 * n3;
    // Where there is no liquid q = 0 and with it A; 1e-30 keeps 0/0 out.
    const float inverse = 1.0F / std::max(squared, 1e-30F);
    const float mobility = scale * centre * centre * centre * std::sqrt(inverse);
    const float bx = gradientX - wx * n3;
    const float by = gradientY - slopeY * n3;
    const float a11 = (hasW & hasE) ? mobility * (1.0F + wx * wx - bx * bx * inverse) : 0.0F;
    const float a22 = (hasN & hasS) ? mobility * (1.0F + slopeY * slopeY - by * by * inverse) : 0.0F;
    // |a12| below both others keeps Gauss–Seidel a contraction in steep diagonal views.
    const float limit = 0.9F * std::min(a11, a22);
    const float mixed = hasCorners ? mobility * (wx * slopeY - bx * by * inverse) : 0.0F;
    const float a12 = std::min(std::max(mixed, -limit), limit);
    c11[i] = a11;
    c12[i] = a12;
    c22[i] = a22;
    b[i] = a11 * (e - 2.0F * centre + w) + a22 * (n - 2.0F * centre + s) + 0.5F * a12 * (se - sw - ne + nw);
  }
}

SLUICE_SIMD_CLONES void applyRow(float* __restrict q, const float* __restrict change, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    // A change beyond a factor of two is an unconverged silhouette, not smoothing. 0 stays 0.
    q[i] = std::min(std::max(q[i] + change[i], 0.5F * q[i]), 2.0F * q[i]);
  }
}

LiquidBounds findLiquid(std::span<const float> q, core::ImageSize size, std::vector<RowSpan>& spans) {
  spans.assign(static_cast<std::size_t>(size.height), {});
  LiquidBounds bounds{size.width, 0, size.height, 0};
  for (int y = 0; y < size.height; ++y) {
    const RowSpan span =
        liquidSpan(q.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width), size.width);
    if (span.width() <= 0) continue;
    spans[static_cast<std::size_t>(y)] = span;
    bounds = {std::min(bounds.first, span.first), std::max(bounds.last, span.last), std::min(bounds.top, y), y + 1};
  }
  return bounds;
}

}  // namespace

ImplicitCurvatureFlow::ImplicitCurvatureFlow() = default;
ImplicitCurvatureFlow::~ImplicitCurvatureFlow() = default;

void ImplicitCurvatureFlow::fitGrids(int width, int height) {
  // Grids a little larger than needed serve while the liquid moves about; everything outside the spans is zero.
  constexpr int kGrain = 64;
  const auto roundUp = [](int n) { return (n + kGrain - 1) / kGrain * kGrain; };
  width = roundUp(width);
  height = roundUp(height);
  width_ = width;
  height_ = height;
  grids_ = std::make_unique<Multigrid>(width, height);
}

void ImplicitCurvatureFlow::smooth(std::span<float> q, core::ImageSize size, const FlowSettings& settings) {
  SLUICE_CHECK_EQ(q.size(), static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  std::vector<RowSpan> spans;
  const LiquidBounds bounds = findLiquid(q, size, spans);
  if (bounds.first >= bounds.last || settings.time <= 0.0F) return;
  fitGrids(bounds.last - bounds.first, bounds.bottom - bounds.top);
  Multigrid::Level& fine = grids_->finest();

  const int rows = bounds.bottom - bounds.top;
  PaddedField picture(fine.width, fine.height);
  const auto source = [&](int y) {
    return q.data() + static_cast<std::size_t>(y + bounds.top) * static_cast<std::size_t>(size.width) + bounds.first;
  };
  for (int y = 0; y < rows; ++y) {
    const RowSpan span = spans[static_cast<std::size_t>(y + bounds.top)];
    fine.spans[static_cast<std::size_t>(y)] =
        span.width() > 0 ? RowSpan{span.first - bounds.first, span.last - bounds.first} : RowSpan{};
    std::copy_n(source(y), bounds.last - bounds.first, picture.row(y));
  }

  const float slopeX = settings.pixelSlope * (static_cast<float>(bounds.first) + 0.5F - 0.5F * size.width);
  const float timeStep = settings.time / static_cast<float>(settings.steps);
  for (int step = 0; step < settings.steps; ++step) {
    for (int y = 0; y < rows; ++y) {
      const RowSpan span = fine.spans[static_cast<std::size_t>(y)];
      const float slopeY = settings.pixelSlope * (static_cast<float>(y + bounds.top) + 0.5F - 0.5F * size.height);
      coefficientRow({picture.row(y - 1), picture.row(y), picture.row(y + 1), fine.c11.row(y), fine.c12.row(y),
                      fine.c22.row(y), fine.b.row(y)},
                     span.first, span.last, slopeX, slopeY, settings.pixelSlope, timeStep, settings.edge);
    }
    grids_->prepare();
    grids_->solve(settings.cycles);
    for (int y = 0; y < rows; ++y) {
      const RowSpan span = fine.spans[static_cast<std::size_t>(y)];
      applyRow(picture.row(y), fine.x.row(y), span.first, span.last);
    }
  }
  for (int y = 0; y < rows; ++y) std::copy_n(picture.row(y), bounds.last - bounds.first, source(y));
}

}  // namespace sluice::render
