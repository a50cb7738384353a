#include "thickness_smoothing.h"

#include <algorithm>
#include <cmath>

#include "sluice/core/simd.h"

namespace sluice::render {

namespace {

/// 1/ρ² of a pixel that keeps to itself.
constexpr float kAlone = 1e6F;

/// One row of the result; `line` is the row, and the neighbours i steps away lie i·step before and behind.
SLUICE_SIMD_CLONES void exchange(const float* __restrict line, std::ptrdiff_t step, int reach,
                                 const float* __restrict inverseSquare, float* __restrict result, int width) {
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float own = line[x];
    float change = 0.0F;
    float weights = 1.0F;
    for (int i = 1; i <= reach; ++i) {
      const float root = std::max(1.0F - static_cast<float>(i * i) * inverseSquare[x], 0.0F);
      const float weight = root * root;
      const float before = line[x - i * step];
      const float after = line[x + i * step];
      change += weight * ((before > 0.0F ? before - own : 0.0F) + (after > 0.0F ? after - own : 0.0F));
      weights += 2.0F * weight;
    }
    result[x] = own > 0.0F ? own + change / weights : 0.0F;
  }
}

}  // namespace

void ThicknessSmoothing::findReach(const ViewGeometry& thicknessView, std::span<const float> surface,
                                   const ViewGeometry& surfaceView, float deviation) {
  const int width = thicknessView.size.width;
  const int height = thicknessView.size.height;
  const float ratio = thicknessView.pixelSlope / surfaceView.pixelSlope;
  const auto index = [&](int i, int count, int surfaceCount) {
    const float place = (static_cast<float>(i) + 0.5F - 0.5F * static_cast<float>(count)) * ratio +
                        0.5F * static_cast<float>(surfaceCount);
    return std::clamp(static_cast<int>(place), 0, surfaceCount - 1);
  };
  inverseSquare_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  rowReach_.resize(static_cast<std::size_t>(height));
  const float scale = kReachOfDeviation * deviation / thicknessView.pixelSlope;
#pragma omp parallel for schedule(static)
  for (int y = 0; y < height; ++y) {
    const float* const q = surface.data() + static_cast<std::ptrdiff_t>(index(y, height, surfaceView.size.height)) *
                                                surfaceView.size.width;
    float* const inverse = inverseSquare_.data() + static_cast<std::ptrdiff_t>(y) * width;
    float largest = 0.0F;
    for (int x = 0; x < width; ++x) {
      // At the rim, where a pixel's middle may have no surface, there is no depth to go by.
      const float reach =
          std::min(scale * q[index(x, width, surfaceView.size.width)], static_cast<float>(kLargestReach));
      inverse[x] = reach > 0.0F ? 1.0F / (reach * reach) : kAlone;
      largest = std::max(largest, reach);
    }
    rowReach_[static_cast<std::size_t>(y)] = static_cast<int>(std::ceil(largest));
  }
}

void ThicknessSmoothing::smooth(std::span<float> thickness, const ViewGeometry& thicknessView,
                                std::span<const float> surface, const ViewGeometry& surfaceView, float deviation) {
  findReach(thicknessView, surface, surfaceView, deviation);
  const int width = thicknessView.size.width;
  const int height = thicknessView.size.height;
  const std::ptrdiff_t stride = width + 2 * kLargestReach;
  padded_.assign(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height + 2 * kLargestReach), 0.0F);
  const auto paddedRow = [&](int y) { return padded_.data() + (y + kLargestReach) * stride + kLargestReach; };
  const auto row = [&](int y) { return thickness.data() + static_cast<std::ptrdiff_t>(y) * width; };
  for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, stride}) {
    for (int y = 0; y < height; ++y) std::copy_n(row(y), width, paddedRow(y));
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; ++y) {
      exchange(paddedRow(y), step, rowReach_[static_cast<std::size_t>(y)],
               inverseSquare_.data() + static_cast<std::ptrdiff_t>(y) * width, row(y), width);
    }
  }
}

}  // namespace sluice::render
