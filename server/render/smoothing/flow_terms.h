#pragma once

#include <algorithm>
#include <cmath>

#include "smoothing/flow_rows.h"

namespace sluice::render {

// What the explicit and the implicit curvature flow have in common at one pixel. Inlined into their loops, or those
// would not become vector code.

/// 1 where |z − z_j| ≤ edge, as in surface.glsl, else 0; `reach` is edge·q. No liquid, 0, is on no surface but that of
/// no liquid. Numbers instead of truth values: products of them become vector code, branches do not.
[[gnu::always_inline]] inline float onOneSurface(float reach, float q, float neighbour) {
  return std::abs(neighbour - q) <= reach * neighbour ? 1.0F : 0.0F;
}

/// Links between a pixel and its neighbours, as numbers.
struct Links {
  float w, e, n, s, corners;
};

[[gnu::always_inline]] inline Links linksOf(const RowAndNeighbours& rows, int i, float edge) {
  const float q = rows.q[i];
  const float reach = edge * q;
  return {onOneSurface(reach, q, rows.q[i - 1]), onOneSurface(reach, q, rows.q[i + 1]),
          onOneSurface(reach, q, rows.above[i]), onOneSurface(reach, q, rows.below[i]),
          onOneSurface(reach, q, rows.above[i - 1]) * onOneSurface(reach, q, rows.above[i + 1]) *
              onOneSurface(reach, q, rows.below[i - 1]) * onOneSurface(reach, q, rows.below[i + 1])};
}

/// A, times a factor.
struct FlowTensor {
  float xx, xy, yy;
};

/// scale·q³/|N|·[I + W Wᵀ − b bᵀ/|N|²],  N = (q_X, q_Y, q − W·∇q),  b = ∇q − W·N_3, at the view slope (wx, wy).
/// `perPixel` is 1/C.
[[gnu::always_inline]] inline FlowTensor flowTensor(const RowAndNeighbours& rows, int i, const Links& has, float wx,
                                                    float wy, float scale, float perPixel) {
  const float q = rows.q[i];
  // Slopes with ghost values 2q − q_opposite across a silhouette, and q where both neighbours are gone.
  const float stepW = has.w * (q - rows.q[i - 1]);
  const float stepE = has.e * (rows.q[i + 1] - q);
  const float stepN = has.n * (q - rows.above[i]);
  const float stepS = has.s * (rows.below[i] - q);
  const float forwardX = stepE + (1.0F - has.e) * stepW;
  const float backwardX = stepW + (1.0F - has.w) * stepE;
  const float forwardY = stepS + (1.0F - has.s) * stepN;
  const float backwardY = stepN + (1.0F - has.n) * stepS;
  const float gradientX = 0.5F * perPixel * (forwardX + backwardX);
  const float gradientY = 0.5F * perPixel * (forwardY + backwardY);
  const float n3 = q - wx * gradientX - wy * gradientY;
  // 1e-30 keeps 0/0 out where there is no liquid; the cube below makes A zero there.
  const float inverse = 1.0F / std::max(gradientX * gradientX + gradientY * gradientY + n3 * n3, 1e-30F);
  const float mobility = scale * q * q * q * std::sqrt(inverse);
  const float bx = gradientX - wx * n3;
  const float by = gradientY - wy * n3;
  return {mobility * (1.0F + wx * wx - bx * bx * inverse), mobility * (wx * wy - bx * by * inverse),
          mobility * (1.0F + wy * wy - by * by * inverse)};
}

/// Second differences of q; `mixed` is four times q_xy.
struct SecondDifferences {
  float xx, mixed, yy;
};

[[gnu::always_inline]] inline SecondDifferences secondDifferences(const RowAndNeighbours& rows, int i) {
  return {rows.q[i + 1] - 2.0F * rows.q[i] + rows.q[i - 1],
          rows.below[i + 1] - rows.below[i - 1] - rows.above[i + 1] + rows.above[i - 1],
          rows.below[i] - 2.0F * rows.q[i] + rows.above[i]};
}

}  // namespace sluice::render
