#include "refine_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sluice/core/check.h"
#include "sluice/core/simd.h"

namespace sluice::render {

namespace {

/// Where the middle of a fine pixel falls between those of two coarse ones.
struct Between {
  int first;
  int second;
  float share;  ///< Of the second, at most a half: the first is the nearer.
};

Between between(int fine, int fineCount, int coarseCount) {
  const float place = 0.5F * (static_cast<float>(fine) + 0.5F - 0.5F * static_cast<float>(fineCount)) +
                      0.5F * static_cast<float>(coarseCount) - 0.5F;
  const float nearest = std::floor(place + 0.5F);
  const int first = std::clamp(static_cast<int>(nearest), 0, coarseCount - 1);
  const int second = std::clamp(first + (place < nearest ? -1 : 1), 0, coarseCount - 1);
  return {first, second, std::abs(place - nearest)};
}

[[gnu::always_inline]] inline float blend(float near, float other, float share, float edge) {
  const float difference = other - near;
  const bool joined = std::abs(difference) <= edge * near * other;
  return near <= 0.0F ? other : joined ? near + share * difference : near;
}

SLUICE_SIMD_CLONES void blendRows(const float* __restrict near, const float* __restrict other, float share, float edge,
                                  float* __restrict result, int width) {
  for (int x = 0; x < width; ++x) result[x] = blend(near[x], other[x], share, edge);
}

}  // namespace

void refineSurface(std::span<const float> coarse, core::ImageSize coarseSize, float edge, std::span<float> fine,
                   core::ImageSize fineSize) {
  SLUICE_CHECK_EQ(coarseSize.width, (fineSize.width + 1) / 2);
  SLUICE_CHECK_EQ(coarseSize.height, (fineSize.height + 1) / 2);
  std::vector<Between> columns;
  for (int x = 0; x < fineSize.width; ++x) columns.push_back(between(x, fineSize.width, coarseSize.width));
  const auto rowOf = [&](int y) {
    return coarse.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(coarseSize.width);
  };
#pragma omp parallel
  {
    std::vector<float> row(static_cast<std::size_t>(coarseSize.width));
#pragma omp for schedule(static)
    for (int y = 0; y < fineSize.height; ++y) {
      const Between rows = between(y, fineSize.height, coarseSize.height);
      blendRows(rowOf(rows.first), rowOf(rows.second), rows.share, edge, row.data(), coarseSize.width);
      float* const result = fine.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(fineSize.width);
      for (std::size_t x = 0; x < columns.size(); ++x) {
        const auto& [first, second, share] = columns[x];
        result[x] = blend(row[static_cast<std::size_t>(first)], row[static_cast<std::size_t>(second)], share, edge);
      }
    }
  }
}

}  // namespace sluice::render
