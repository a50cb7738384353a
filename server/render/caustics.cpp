#include "caustics.h"

#include <algorithm>
#include <cmath>

#include "light_rows.h"

namespace sluice::render {

namespace {

/// Rays that start in each cell of the coarse grid: one in each of its quarters.
constexpr int kRays = 4;

/// Rows of the fine grid that one thread fills at a time.
constexpr int kStripRows = 32;

}  // namespace

std::span<const float> Caustics::focus(const CausticsInput& input, const LightGrid& grid) {
  const LightGrid fine = refined(grid);
  trace(input, grid);
  land(fine);
  blur(fine);
  return flux_;
}

void Caustics::trace(const CausticsInput& input, const LightGrid& grid) {
  const int width = grid.width;
  const int height = grid.height;
  slopeX_.assign(grid.cells(), 0.0F);
  slopeY_.assign(grid.cells(), 0.0F);
  u_.resize(kRays * grid.cells());
  v_.resize(kRays * grid.cells());
  firstRow_.resize(static_cast<std::size_t>(kRays * height));
  lastRow_.resize(static_cast<std::size_t>(kRays * height));
  const auto at = [&](auto& cells, int y) { return cells.data() + static_cast<std::ptrdiff_t>(y) * width; };
#pragma omp parallel for schedule(static)
  for (int y = 1; y < height - 1; ++y) {
    slopeRow({at(input.front, y - 1) + 1, at(input.front, y) + 1, at(input.front, y + 1) + 1}, input.limit,
             1.0F / grid.cell, at(slopeX_, y) + 1, at(slopeY_, y) + 1, width - 2);
  }
#pragma omp parallel for schedule(dynamic, 8)
  for (int y = 0; y < height; ++y) {
    for (int k = 0; k < kRays; ++k) {
      const int sideX = k % 2 == 0 ? -1 : 1;
      const int sideY = k < 2 ? -1 : 1;
      const int line = kRays * y + k;
      float* const u = at(u_, line);
      float* const v = at(v_, line);
      // Where the rays would land unrefracted, as all those do that start along the border: there is no liquid there.
      const float firstU = 1.0F + 0.5F * static_cast<float>(sideX);
      const float firstV = static_cast<float>(2 * y) + 1.0F + 0.5F * static_cast<float>(sideY);
      for (int x = 0; x < width; ++x) u[x] = firstU + static_cast<float>(2 * x);
      std::fill_n(v, width, firstV);
      const bool border = y == 0 || y == height - 1;
      if (!border) traceRow(rays(input, grid, y, sideX, sideY), u + 1, v + 1, width - 2);
      const auto [first, last] = std::minmax_element(v, v + width);
      firstRow_[static_cast<std::size_t>(line)] = static_cast<std::int16_t>(std::floor(*first - 0.5F));
      lastRow_[static_cast<std::size_t>(line)] = static_cast<std::int16_t>(std::floor(*last + 0.5F));
    }
  }
}

RayRow Caustics::rays(const CausticsInput& input, const LightGrid& grid, int y, int sideX, int sideY) const {
  const auto at = [&](const auto& cells, int row) {
    return cells.data() + static_cast<std::ptrdiff_t>(row) * grid.width + 1;
  };
  return {.rows = {at(input.front, y - 1), at(input.front, y), at(input.front, y + 1)},
          .slopeX = at(slopeX_, y),
          .slopeY = at(slopeY_, y),
          .besideFront = at(input.front, y + sideY),
          .besideSlopeX = at(slopeX_, y + sideY),
          .besideSlopeY = at(slopeY_, y + sideY),
          .inverseIndex = at(input.inverseIndex, y),
          .receiver = input.receiver.empty() ? nullptr : at(input.receiver, y),
          .side = sideX,
          .sideY = static_cast<float>(sideY),
          .y = grid.corner.y() + (static_cast<float>(y) + 0.5F) * grid.cell,
          .cell = grid.cell,
          .downY = grid.axes.down.y(),
          .alongY = grid.axes.along.y(),
          .floorHeight = input.floorHeight,
          .firstU = 3.0F + 0.5F * static_cast<float>(sideX),
          .v = static_cast<float>(2 * y) + 1.0F + 0.5F * static_cast<float>(sideY),
          .perMetre = 2.0F / grid.cell,
          .most = static_cast<float>(4 * std::max(grid.width, grid.height))};
}

void Caustics::land(const LightGrid& fine) {
  const int width = fine.width;
  flux_.assign(fine.cells(), 0.0F);
  const auto lines = static_cast<int>(firstRow_.size());
  const int perLine = width / 2;
  const auto lastColumn = static_cast<float>(width - 1);
#pragma omp parallel for schedule(dynamic)
  for (int top = 0; top < fine.height; top += kStripRows) {
    const int bottom = std::min(top + kStripRows, fine.height);
    for (int line = 0; line < lines; ++line) {
      if (firstRow_[static_cast<std::size_t>(line)] >= bottom || lastRow_[static_cast<std::size_t>(line)] < top) {
        continue;
      }
      const float* const u = u_.data() + static_cast<std::ptrdiff_t>(line) * perLine;
      const float* const v = v_.data() + static_cast<std::ptrdiff_t>(line) * perLine;
      for (int i = 0; i < perLine; ++i) {
        const float x = u[i] - 0.5F;
        const float y = v[i] - 0.5F;
        const float row = std::floor(y);
        const float column = std::floor(x);
        if (column < 0.0F || column > lastColumn) continue;
        const float right = x - column;
        const float below = y - row;
        const auto upper = static_cast<int>(row);
        const auto left = static_cast<std::ptrdiff_t>(column);
        const std::ptrdiff_t next = column < lastColumn ? 1 : 0;
        const auto add = [&](int target, float share) {
          if (target < top || target >= bottom) return;
          float* const cell = flux_.data() + static_cast<std::ptrdiff_t>(target) * width + left;
          cell[0] += (1.0F - right) * share;
          cell[next] += right * share;
        };
        add(upper, 1.0F - below);
        add(upper + 1, below);
      }
    }
  }
}

void Caustics::blur(const LightGrid& fine) {
  // Rays that start a cell apart may land farther apart: so much blur that the gaps between them close.
  const int width = fine.width;
  scratch_.resize(flux_.size());
  const auto row = [&](std::vector<float>& cells, int y) {
    return cells.data() + static_cast<std::ptrdiff_t>(y) * width;
  };
#pragma omp parallel for schedule(static)
  for (int y = 0; y < fine.height; ++y) {
    float* const result = row(scratch_, y);
    std::copy_n(row(flux_, y), width, result);
    blurRow(row(flux_, y) + 2, 1, result + 2, width - 4);
  }
#pragma omp parallel for schedule(static)
  for (int y = 2; y < fine.height - 2; ++y) blurRow(row(scratch_, y), width, row(flux_, y), width);
}

}  // namespace sluice::render
