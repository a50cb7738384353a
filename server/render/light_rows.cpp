#include "light_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sluice/core/simd.h"

namespace sluice::render {

namespace {

// Helpers of cloned functions must be inlined, or every clone would call the one version for all instruction sets.

[[gnu::always_inline]] inline float within(float difference, float limit) {
  return std::abs(difference) < limit ? difference : 0.0F;
}

[[gnu::always_inline]] inline float isWithin(float difference, float limit) {
  return std::abs(difference) < limit ? 1.0F : 0.0F;
}

/// e^(−x) for x ≥ 0, to seven digits: 2^(−n)·2^(−f) with whole n and |f| ≤ ½.
[[gnu::always_inline]] inline float decay(float x) {
  constexpr float kLog2E = 1.44269504F;
  constexpr float kLn2 = 0.69314718F;
  const float power = std::min(x * kLog2E, 125.0F);  // beyond, powers of two leave the range of normal numbers
  const float whole = std::floor(power + 0.5F);
  const float f = (whole - power) * kLn2;
  const float polynomial =
      1.0F + f * (1.0F + f * (0.5F + f * (1.0F / 6 + f * (1.0F / 24 + f * (1.0F / 120 + f * (1.0F / 720))))));
  const auto exponent = static_cast<std::uint32_t>(127 - static_cast<std::int32_t>(whole)) << 23U;
  return polynomial * std::bit_cast<float>(exponent);
}

}  // namespace

SLUICE_SIMD_CLONES void exchangeRow(const float* __restrict from, std::ptrdiff_t step, float limit,
                                    float* __restrict to, int count) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float own = from[i];
    to[i] = own + (within(from[i - step] - own, limit) + within(from[i + step] - own, limit)) * (1.0F / 3.0F);
  }
}

SLUICE_SIMD_CLONES void slopeRow(const FrontRows& rows, float limit, float inverseCell, float* __restrict slopeX,
                                 float* __restrict slopeY, int count) {
  const float* const __restrict above = rows.above;
  const float* const __restrict front = rows.front;
  const float* const __restrict below = rows.below;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float own = front[i];
    const float left = own - front[i - 1];
    const float right = front[i + 1] - own;
    const float up = own - above[i];
    const float down = below[i] - own;
    const float acrossX = std::max(isWithin(left, limit) + isWithin(right, limit), 1.0F);
    const float acrossY = std::max(isWithin(up, limit) + isWithin(down, limit), 1.0F);
    slopeX[i] = (within(left, limit) + within(right, limit)) * inverseCell / acrossX;
    slopeY[i] = (within(up, limit) + within(down, limit)) * inverseCell / acrossY;
  }
}

SLUICE_SIMD_CLONES void traceRow(const RayRow& row, float* __restrict u, float* __restrict v, int count) {
  /// Rays that fall less than this per metre never arrive, as far as the light map goes.
  constexpr float kLeastFall = 1e-3F;
  const RayRow r = row;
  const float quarterX = 0.25F * static_cast<float>(r.side);
  const float quarterY = 0.25F * r.sideY;
  const float startY = r.y + quarterY * r.cell;
  const float* const __restrict front = r.rows.front;
  const float* const __restrict receiver = r.receiver == nullptr ? front : r.receiver;
  const float noReceiver = r.receiver == nullptr ? 2.0F * kEmptyCell : 0.0F;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const bool liquid = front[i] < kEmptyCell;
    const int next = i + r.side;
    // Slopes go over from cell to cell in a plane through this cell and its two neighbours, as far as there are any.
    const float towardsX = front[next] < kEmptyCell ? quarterX * static_cast<float>(r.side) : 0.0F;
    const float towardsY = r.besideFront[i] < kEmptyCell ? quarterY * r.sideY : 0.0F;
    const float sx =
        r.slopeX[i] + towardsX * (r.slopeX[next] - r.slopeX[i]) + towardsY * (r.besideSlopeX[i] - r.slopeX[i]);
    const float sy =
        r.slopeY[i] + towardsX * (r.slopeY[next] - r.slopeY[i]) + towardsY * (r.besideSlopeY[i] - r.slopeY[i]);
    const float z = front[i] + r.cell * (quarterX * sx + quarterY * sy);

    // Snell: light along (0, 0, 1) meets the normal (s_x, s_y, −1)·cosθ.
    const float squaredCosine = 1.0F / (1.0F + sx * sx + sy * sy);
    const float cosine = std::sqrt(squaredCosine);
    const float eta = r.inverseIndex[i];
    const float along = eta * cosine - std::sqrt(1.0F - eta * eta * (1.0F - squaredCosine));
    const float tx = along * cosine * sx;
    const float ty = along * cosine * sy;
    const float tz = eta - along * cosine;

    const float height = startY * r.downY + z * r.alongY - r.floorHeight;
    const float fall = -(ty * r.downY + tz * r.alongY);
    const float untilFloor = height / std::max(fall, kLeastFall);
    const float untilReceiver = (receiver[i] + noReceiver - z) / tz;
    const float length = std::max(std::min(untilFloor, untilReceiver), 0.0F);
    const float cells = liquid ? length * r.perMetre : 0.0F;
    u[i] = r.firstU + 2.0F * static_cast<float>(i) + std::clamp(cells * tx, -r.most, r.most);
    v[i] = r.v + std::clamp(cells * ty, -r.most, r.most);
  }
}

SLUICE_SIMD_CLONES void addOpticalDepth(const float* __restrict thickness, float sigma, float* __restrict optical,
                                        int count) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) optical[i] += sigma * thickness[i];
}

SLUICE_SIMD_CLONES void transmitRow(const float* __restrict optical, float* __restrict share, int count) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) share[i] = decay(optical[i]);
}

SLUICE_SIMD_CLONES void blurRow(const float* __restrict line, std::ptrdiff_t step, float* __restrict result,
                                int count) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    result[i] = 0.375F * line[i] + 0.25F * (line[i - step] + line[i + step]) +
                0.0625F * (line[i - 2 * step] + line[i + 2 * step]);
  }
}

SLUICE_SIMD_CLONES void sunlightRow(const SunlightRow& row, float* __restrict texels, int coarseCount) {
  const SunlightRow r = row;
#pragma GCC ivdep
  for (int i = 0; i < coarseCount; ++i) {
    float* const cell = texels + 8 * static_cast<std::ptrdiff_t>(i);
    const float focusLeft = r.focus == nullptr ? 1.0F : 1.0F + r.caustics * (r.focus[2 * i] - 1.0F);
    const float focusRight = r.focus == nullptr ? 1.0F : 1.0F + r.caustics * (r.focus[2 * i + 1] - 1.0F);
    for (int channel = 0; channel < 3; ++channel) {
      const float* const own = r.own[channel] + i;
      const float* const beside = r.beside[channel] + i;
      const float middle = 0.75F * own[0] + 0.25F * beside[0];
      cell[channel] = focusLeft * (0.75F * middle + 0.25F * (0.75F * own[-1] + 0.25F * beside[-1]));
      cell[4 + channel] = focusRight * (0.75F * middle + 0.25F * (0.75F * own[1] + 0.25F * beside[1]));
    }
    cell[3] = r.front[i];
    cell[7] = r.front[i];
  }
}

}  // namespace sluice::render
