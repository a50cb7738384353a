#include "light_surface.h"

#include <algorithm>
#include <cmath>

#include "light_rows.h"
#include "line_smoothing.h"

namespace sluice::render {

namespace {

/// Parts that the particles are cut into, each with a picture of its own, whatever the number of threads: sums come
/// about in the same order.
constexpr std::size_t kParts = 4;

/// Radius of a particle's cap: as splats usually have it, wide enough to close a lattice.
constexpr float kCapRadius = 0.9F;

/// A cap is at most this many cells wide: cells are no smaller than half a spacing.
constexpr int kCapCells = 4;

/// Standard deviation of what thickness is smoothed over, particle spacings: single particles do not show.
constexpr float kThicknessDeviation = 1.0F;

/// A particle's volume, as the length `amount` that it has on one cell, shared out among the four cells around (x, y).
[[gnu::always_inline]] inline void shareOut(float x, float y, float amount, float* thickness, std::size_t width) {
  const float left = std::floor(x - 0.5F);
  const float top = std::floor(y - 0.5F);
  const float right = x - 0.5F - left;
  const float bottom = y - 0.5F - top;
  float* const upper = thickness + static_cast<std::size_t>(top) * width + static_cast<std::size_t>(left);
  float* const lower = upper + width;
  upper[0] += amount * (1.0F - right) * (1.0F - bottom);
  upper[1] += amount * right * (1.0F - bottom);
  lower[0] += amount * (1.0F - right) * bottom;
  lower[1] += amount * right * bottom;
}

struct CapShape {
  float radius;  ///< Cells.
  float bend;    ///< 1/2R, m per cell².
};

/// The paraboloid that touches a particle's sphere where light meets it first, at depth `top`, out to its radius.
[[gnu::always_inline]] inline void drawCap(float x, float y, float top, const CapShape& cap, float* front,
                                           std::size_t width) {
  const float firstX = std::ceil(x - 0.5F - cap.radius);
  const float firstY = std::ceil(y - 0.5F - cap.radius);
  float* row = front + static_cast<std::size_t>(firstY) * width + static_cast<std::size_t>(firstX);
  for (int j = 0; j < kCapCells; ++j, row += width) {
    const float dy = firstY + static_cast<float>(j) + 0.5F - y;
    for (int i = 0; i < kCapCells; ++i) {
      const float dx = firstX + static_cast<float>(i) + 0.5F - x;
      const float squared = dx * dx + dy * dy;
      row[i] = std::min(row[i], squared <= cap.radius * cap.radius ? top + cap.bend * squared : kNoLiquid);
    }
  }
}

}  // namespace

SunlitBounds LightSurface::bounds(const SunlitParticles& particles, const LightAxes& axes) {
  float left = kNoLiquid;
  float top = kNoLiquid;
  float right = -kNoLiquid;
  float bottom = -kNoLiquid;
  float highest = -kNoLiquid;
  const auto count = static_cast<std::ptrdiff_t>(particles.positions.size());
#pragma omp parallel for schedule(static) reduction(min : left, top) reduction(max : right, bottom, highest)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Eigen::Vector3f& p = particles.positions[static_cast<std::size_t>(i)];
    if (p.y() < particles.floorHeight) continue;
    const float x = p.dot(axes.right);
    const float y = p.dot(axes.down);
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
    highest = std::max(highest, p.y());
  }
  if (left > right) return {};
  return {Eigen::AlignedBox2f(Eigen::Vector2f(left, top), Eigen::Vector2f(right, bottom)), highest};
}

void LightSurface::draw(const SunlitParticles& particles, std::size_t liquids, const LightGrid& grid) {
  parts_.resize(kParts);
  const std::size_t count = particles.positions.size();
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < kParts; ++k) {
    parts_[k].resize(liquids);
    for (Layer& layer : parts_[k]) {
      layer.front.assign(grid.cells(), kNoLiquid);
      layer.thickness.assign(grid.cells(), 0.0F);
    }
    drawPart(particles, grid, count * k / kParts, count * (k + 1) / kParts, parts_[k]);
  }
  join(liquids, grid);
  const float deviation = kThicknessDeviation * particles.spacing / grid.cell;
  for (std::vector<float>& thickness : thickness_) {
    smoothLines(thickness, grid.width, {.sweeps = sweepsFor(deviation), .limit = kNoLiquid, .outside = 0.0F});
  }
}

void LightSurface::drawPart(const SunlitParticles& particles, const LightGrid& grid, std::size_t first,
                            std::size_t last, Part& part) {
  const float inverseCell = 1.0F / grid.cell;
  const float radius = kCapRadius * particles.spacing;
  const CapShape cap{radius * inverseCell, grid.cell * grid.cell / (2.0F * radius)};
  const float amount = particles.spacing * particles.spacing * particles.spacing * inverseCell * inverseCell;
  for (std::size_t i = first; i < last; ++i) {
    const Eigen::Vector3f& p = particles.positions[i];
    if (p.y() < particles.floorHeight) continue;
    const Eigen::Vector3f place = grid.axes.toLight(p);
    const std::size_t fluid = particles.fluids.empty() ? 0 : particles.fluids[i];
    Layer& layer = part[fluid < part.size() ? fluid : 0];  // fluids beyond the looks have the first
    const float x = (place.x() - grid.corner.x()) * inverseCell;
    const float y = (place.y() - grid.corner.y()) * inverseCell;
    const auto width = static_cast<std::size_t>(grid.width);
    shareOut(x, y, amount, layer.thickness.data(), width);
    drawCap(x, y, place.z() - radius, cap, layer.front.data(), width);
  }
}

void LightSurface::join(std::size_t liquids, const LightGrid& grid) {
  front_.resize(grid.cells());
  frontLiquid_.resize(liquids > 1 ? grid.cells() : 0);
  thickness_.resize(liquids);
  for (std::vector<float>& thickness : thickness_) thickness.resize(grid.cells());
#pragma omp parallel for schedule(static)
  for (int y = 0; y < grid.height; ++y) {
    const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width);
    const std::size_t last = first + static_cast<std::size_t>(grid.width);
    std::fill(front_.data() + first, front_.data() + last, kNoLiquid);
    for (std::size_t liquid = 0; liquid < liquids; ++liquid) {
      const auto front = [&](std::size_t k) { return parts_[k][liquid].front.data(); };
      const auto thickness = [&](std::size_t k) { return parts_[k][liquid].thickness.data(); };
      for (std::size_t i = first; i < last; ++i) {
        const float depth = std::min({front(0)[i], front(1)[i], front(2)[i], front(3)[i]});
        thickness_[liquid][i] = (thickness(0)[i] + thickness(1)[i]) + (thickness(2)[i] + thickness(3)[i]);
        if (!frontLiquid_.empty() && depth <= front_[i]) frontLiquid_[i] = static_cast<std::uint8_t>(liquid);
        front_[i] = std::min(front_[i], depth);
      }
    }
  }
}

void LightSurface::smoothFront(const LightGrid& grid, float deviation, float spacing) {
  smoothLines(front_, grid.width,
              {.sweeps = sweepsFor(deviation / grid.cell), .limit = kStepOfFront * spacing, .outside = kNoLiquid});
}

}  // namespace sluice::render
