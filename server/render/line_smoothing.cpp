#include "line_smoothing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "light_rows.h"

namespace sluice::render {

namespace {

/// The axes take turns: what one does across steps of the front, the other sees.
constexpr int kTurns = 2;

/// Standard deviation of 6.5 cells.
constexpr int kMostSweeps = 64;

/// Columns that are smoothed at once: a cache line.
constexpr int kColumns = 16;

/// Sweeps to and fro between two copies of some lines, cell by cell `step` apart, with one cell before and one behind.
/// Gives the copy that holds the result.
const float* sweep(std::vector<float>& from, std::vector<float>& to, std::ptrdiff_t step, int count, int sweeps,
                   float limit) {
  for (int i = 0; i < sweeps; ++i) {
    exchangeRow(from.data() + step, step, limit, to.data() + step, count);
    from.swap(to);
  }
  return from.data() + step;
}

void smoothRows(std::span<float> cells, int width, int sweeps, const LineSmoothing& settings) {
  const auto height = static_cast<int>(cells.size()) / width;
#pragma omp parallel
  {
    std::vector<float> from(static_cast<std::size_t>(width) + 2, settings.outside);
    std::vector<float> to = from;
#pragma omp for schedule(dynamic, 8)
    for (int y = 0; y < height; ++y) {
      float* const row = cells.data() + static_cast<std::ptrdiff_t>(y) * width;
      if (std::all_of(row, row + width, [&](float v) { return v == settings.outside; })) continue;
      std::copy_n(row, width, from.data() + 1);
      std::copy_n(sweep(from, to, 1, width, sweeps, settings.limit), width, row);
    }
  }
}

void smoothColumns(std::span<float> cells, int width, int sweeps, const LineSmoothing& settings) {
  const auto height = static_cast<int>(cells.size()) / width;
#pragma omp parallel
  {
    std::vector<float> from(static_cast<std::size_t>(kColumns) * (static_cast<std::size_t>(height) + 2));
#pragma omp for schedule(static)
    for (int x = 0; x < width; x += kColumns) {
      const int columns = std::min(kColumns, width - x);
      std::ranges::fill(from, settings.outside);
      std::vector<float> to = from;
      for (int y = 0; y < height; ++y) {
        std::copy_n(cells.data() + static_cast<std::ptrdiff_t>(y) * width + x, columns,
                    from.data() + static_cast<std::ptrdiff_t>(y + 1) * kColumns);
      }
      const float* const result = sweep(from, to, kColumns, kColumns * height, sweeps, settings.limit);
      for (int y = 0; y < height; ++y) {
        std::copy_n(result + static_cast<std::ptrdiff_t>(y) * kColumns, columns,
                    cells.data() + static_cast<std::ptrdiff_t>(y) * width + x);
      }
    }
  }
}

}  // namespace

int sweepsFor(float cells) { return std::clamp(static_cast<int>(std::lround(1.5F * cells * cells)), 0, kMostSweeps); }

void smoothLines(std::span<float> cells, int width, const LineSmoothing& settings) {
  int done = 0;
  for (int turn = 1; turn <= kTurns; ++turn) {
    const int sweeps = settings.sweeps * turn / kTurns - done;
    if (sweeps == 0) continue;
    smoothRows(cells, width, sweeps, settings);
    smoothColumns(cells, width, sweeps, settings);
    done += sweeps;
  }
}

}  // namespace sluice::render
