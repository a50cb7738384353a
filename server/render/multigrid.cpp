#include "multigrid.h"

#include <algorithm>
#include <cmath>

#include "simd.h"

namespace sluice::render {

namespace {

/// Damping of the smoother. 0.8 damps the highest frequencies along rows, which plain Jacobi leaves standing.
constexpr float kDamping = 0.8F;

/// Coarsest grid worth having, and the sweeps that solve it.
constexpr int kLeastEdge = 8;
constexpr int kCoarsestSweeps = 8;

/// One row of coefficients with the rows of x around it.
struct Stencil {
  const float* c11;
  const float* c12;
  const float* c22;
  const float* above;
  const float* x;
  const float* below;
};

Stencil stencilAt(const Multigrid::Level& level, int y) {
  return {level.c11.row(y), level.c12.row(y), level.c22.row(y), level.x.row(y - 1), level.x.row(y), level.x.row(y + 1)};
}

SLUICE_SIMD_CLONES void residualRow(const Stencil& s, const float* __restrict b, float* __restrict r, int first,
                                    int last) {
  const float* const c11 = s.c11;
  const float* const c12 = s.c12;
  const float* const c22 = s.c22;
  const float* const above = s.above;
  const float* const x = s.x;
  const float* const below = s.below;
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    const float xx = x[i - 1] - 2.0F * x[i] + x[i + 1];
    const float yy = above[i] - 2.0F * x[i] + below[i];
    const float xy = below[i + 1] - below[i - 1] - above[i + 1] + above[i - 1];
    r[i] = b[i] - x[i] + (c11[i] * xx + c22[i] * yy + 0.5F * c12[i] * xy);
  }
}

SLUICE_SIMD_CLONES void addScaledRow(float* __restrict x, const float* __restrict r, const float* __restrict scale,
                                     int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) x[i] += kDamping * r[i] * scale[i];
}

SLUICE_SIMD_CLONES void startRow(float* __restrict x, const float* __restrict b, const float* __restrict scale,
                                 int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) x[i] = kDamping * b[i] * scale[i];
}

SLUICE_SIMD_CLONES void inverseDiagonalRow(const float* __restrict c11, const float* __restrict c22,
                                           float* __restrict inverse, int first, int last) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) inverse[i] = 1.0F / (1.0F + 2.0F * (c11[i] + c22[i]));
}

/// Full weighting: coarse pixel i lies on fine pixel 2i+1.
SLUICE_SIMD_CLONES void restrictRow(const float* above, const float* middle, const float* below,
                                    float* __restrict coarse, int first, int last, float scale) {
#pragma GCC ivdep
  for (int i = first; i < last; ++i) {
    const int f = 2 * i + 1;
    const float centre = 4.0F * middle[f] + 2.0F * (middle[f - 1] + middle[f + 1] + above[f] + below[f]);
    const float corners = above[f - 1] + above[f + 1] + below[f - 1] + below[f + 1];
    coarse[i] = scale * (1.0F / 16.0F) * (centre + corners);
  }
}

void restrictField(const PaddedField& fine, PaddedField& coarse, const std::vector<RowSpan>& coarseSpans,
                   float scale = 1.0F) {
  const int rows = static_cast<int>(coarseSpans.size());
  for (int y = 0; y < rows; ++y) {
    const RowSpan span = coarseSpans[static_cast<std::size_t>(y)];
    restrictRow(fine.row(2 * y), fine.row(2 * y + 1), fine.row(2 * y + 2), coarse.row(y), span.first, span.last, scale);
  }
}

/// Adds the bilinear interpolation of one or, on even rows, two coarse rows.
void prolongRow(const float* coarseAbove, const float* coarseBelow, float* fine, RowSpan span) {
  for (int i = span.first; i < span.last; ++i) {
    const int left = (i - 1) >> 1;  // -1 for i = 0: padding
    const int right = i >> 1;       // the same as `left` on odd pixels
    fine[i] += 0.25F * (coarseAbove[left] + coarseAbove[right] + coarseBelow[left] + coarseBelow[right]);
  }
}

void prolongField(const Multigrid::Level& coarse, Multigrid::Level& fine) {
  for (int y = 0; y < fine.height; ++y) {
    prolongRow(coarse.x.row((y - 1) >> 1), coarse.x.row(std::min(y >> 1, coarse.height)), fine.x.row(y),
               fine.spans[static_cast<std::size_t>(y)]);
  }
}

void sweep(Multigrid::Level& level) {
  for (const int parity : {0, 1}) {
    for (int y = parity; y < level.height; y += 2) {
      const RowSpan span = level.spans[static_cast<std::size_t>(y)];
      residualRow(stencilAt(level, y), level.b.row(y), level.residual.row(y), span.first, span.last);
      addScaledRow(level.x.row(y), level.residual.row(y), level.inverseDiagonal.row(y), span.first, span.last);
    }
  }
}

}  // namespace

Multigrid::Level::Level(int levelWidth, int levelHeight)
    : width(levelWidth),
      height(levelHeight),
      spans(static_cast<std::size_t>(levelHeight)),
      c11(levelWidth, levelHeight),
      c12(levelWidth, levelHeight),
      c22(levelWidth, levelHeight),
      inverseDiagonal(levelWidth, levelHeight),
      b(levelWidth, levelHeight),
      x(levelWidth, levelHeight),
      residual(levelWidth, levelHeight) {}

Multigrid::Multigrid(int width, int height) {
  levels_.emplace_back(width, height);
  while (std::min(width, height) >= 2 * kLeastEdge) {
    width /= 2;
    height /= 2;
    levels_.emplace_back(width, height);
  }
}

void Multigrid::prepare() {
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    if (l > 0) {
      const Level& fine = levels_[l - 1];
      for (int y = 0; y < level.height; ++y) {
        RowSpan span{level.width, 0};
        for (int f = 2 * y; f <= std::min(2 * y + 2, fine.height - 1); ++f) {
          const RowSpan from = fine.spans[static_cast<std::size_t>(f)];
          if (from.width() <= 0) continue;
          // Every coarse pixel whose 3x3 fine pixels reach into the span.
          span.first = std::min(span.first, std::max((from.first - 1) / 2, 0));
          span.last = std::max(span.last, std::min(from.last / 2 + 1, level.width));
        }
        level.spans[static_cast<std::size_t>(y)] = span.first < span.last ? span : RowSpan{};
      }
      // Second differences over pixels twice as wide are four times as large.
      restrictField(fine.c11, level.c11, level.spans, 0.25F);
      restrictField(fine.c12, level.c12, level.spans, 0.25F);
      restrictField(fine.c22, level.c22, level.spans, 0.25F);
    }
    for (int y = 0; y < level.height; ++y) {
      const RowSpan span = level.spans[static_cast<std::size_t>(y)];
      inverseDiagonalRow(level.c11.row(y), level.c22.row(y), level.inverseDiagonal.row(y), span.first, span.last);
    }
  }
}

void Multigrid::solve(int cycles) {
  for (int i = 0; i < cycles; ++i) cycle(0, i == 0);
}

void Multigrid::cycle(std::size_t index, bool fromZero) {
  Level& level = levels_[index];
  if (fromZero) {
    for (int y = 0; y < level.height; ++y) {
      const RowSpan span = level.spans[static_cast<std::size_t>(y)];
      startRow(level.x.row(y), level.b.row(y), level.inverseDiagonal.row(y), span.first, span.last);
    }
  } else {
    sweep(level);
  }
  if (index + 1 == levels_.size()) {
    for (int i = 0; i < kCoarsestSweeps; ++i) sweep(level);
    return;
  }

  for (int y = 0; y < level.height; ++y) {
    const RowSpan span = level.spans[static_cast<std::size_t>(y)];
    residualRow(stencilAt(level, y), level.b.row(y), level.residual.row(y), span.first, span.last);
  }
  Level& coarse = levels_[index + 1];
  restrictField(level.residual, coarse.b, coarse.spans);
  cycle(index + 1, true);
  prolongField(coarse, level);
  sweep(level);
}

}  // namespace sluice::render
