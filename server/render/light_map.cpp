#include "light_map.h"

#include <algorithm>
#include <cmath>

namespace sluice::render {

namespace {

/// σ·d of an opaque liquid: a single layer of particles lets 5 % through, and its shadow has a soft rim.
constexpr float kOpaqueLayer = 3.0F;

/// How far around the liquid refracted light is caught, per way that it goes to the floor, and per width of the liquid.
/// Rays turn by a sixth of a right angle where waves are steep; what a crown of spray scatters farther is lost.
constexpr float kReachOfFall = 0.25F;
constexpr float kReachOfWidth = 0.2F;

/// Sunlight's way in a liquid under a level surface, over that without refraction: cosθi/cosθt.
float refractedWay(float rise, float refractiveIndex) {
  return rise / std::sqrt(1.0F - (1.0F - rise * rise) / (refractiveIndex * refractiveIndex));
}

}  // namespace

LightGrid LightMapper::cover(const SunlitParticles& particles, const Eigen::Vector3f& sun, bool caustics) {
  const LightAxes axes = lightAxes(sun);
  const SunlitBounds bounds = LightSurface::bounds(particles, axes);
  if (sun.y() < kLeastRise || bounds.across.isEmpty()) return {};
  float margin = kLightMargin * particles.spacing;
  if (caustics) {
    const float fall = (bounds.highest - particles.floorHeight) / sun.y();
    margin += std::min(kReachOfFall * fall, kReachOfWidth * bounds.across.sizes().maxCoeff());
  }
  return coverWithCells(axes, bounds.across, margin, 0.5F * particles.spacing);
}

const LightMap& LightMapper::make(const SunlitParticles& particles, std::span<const LitLiquid> liquids,
                                  const SunlightSettings& settings) {
  const bool turned = settings.caustics > 0.0F && std::ranges::any_of(liquids, [](const LitLiquid& liquid) {
                        return !liquid.opaque && liquid.refractiveIndex > 1.0F;
                      });
  const LightGrid grid = cover(particles, settings.sun, turned);
  map_.grid = refined(grid);
  map_.texels.resize(4 * map_.grid.cells());
  if (grid.cells() == 0) return map_;
  surface_.draw(particles, liquids.size(), grid);
  transmit(liquids, particles.spacing, settings.sun.y(), grid);
  assemble(turned ? focus(particles, liquids, settings, grid) : std::span<const float>(), settings.caustics, grid);
  return map_;
}

void LightMapper::transmit(std::span<const LitLiquid> liquids, float spacing, float rise, const LightGrid& grid) {
  const auto width = static_cast<std::size_t>(grid.width);
  for (std::vector<float>& share : transmitted_) share.resize(grid.cells());
#pragma omp parallel
  {
    std::vector<float> optical(width);
#pragma omp for schedule(static)
    for (int y = 0; y < grid.height; ++y) {
      const std::size_t first = static_cast<std::size_t>(y) * width;
      for (int channel = 0; channel < 3; ++channel) {
        std::ranges::fill(optical, 0.0F);
        for (std::size_t k = 0; k < liquids.size(); ++k) {
          const float sigma = liquids[k].opaque
                                  ? kOpaqueLayer / spacing
                                  : liquids[k].absorption[channel] * refractedWay(rise, liquids[k].refractiveIndex);
          addOpticalDepth(surface_.thickness(k).data() + first, sigma, optical.data(), grid.width);
        }
        transmitRow(optical.data(), transmitted_[channel].data() + first, grid.width);
      }
    }
  }
}

std::span<const float> LightMapper::focus(const SunlitParticles& particles, std::span<const LitLiquid> liquids,
                                          const SunlightSettings& settings, const LightGrid& grid) {
  const auto inverseIndex = [](const LitLiquid& liquid) {
    return liquid.opaque ? 1.0F : 1.0F / liquid.refractiveIndex;
  };
  inverseIndex_.assign(grid.cells(), inverseIndex(liquids[0]));
  const std::span<const std::uint8_t> inFront = surface_.frontLiquid();
  for (std::size_t i = 0; i < inFront.size(); ++i) inverseIndex_[i] = inverseIndex(liquids[inFront[i]]);
  surface_.smoothFront(grid, settings.surfaceDeviation, particles.spacing);
  return caustics_.focus({.front = surface_.front(),
                          .inverseIndex = inverseIndex_,
                          .receiver = settings.receiver,
                          .limit = kStepOfFront * particles.spacing,
                          .floorHeight = particles.floorHeight},
                         grid);
}

void LightMapper::assemble(std::span<const float> focus, float caustics, const LightGrid& grid) {
  const int height = grid.height;
  const std::ptrdiff_t width = grid.width;
#pragma omp parallel for schedule(static)
  for (int row = 0; row < 2 * height; ++row) {
    const int y = row / 2;
    const int beside = std::clamp(row % 2 == 0 ? y - 1 : y + 1, 0, height - 1);
    float* const texels = map_.texels.data() + 8 * width * row;
    SunlightRow parts{};
    for (int channel = 0; channel < 3; ++channel) {
      parts.own[channel] = transmitted_[channel].data() + width * y + 1;
      parts.beside[channel] = transmitted_[channel].data() + width * beside + 1;
    }
    parts.front = surface_.front().data() + width * y + 1;
    parts.focus = focus.empty() ? nullptr : focus.data() + 2 * (width * row + 1);
    parts.caustics = caustics;
    sunlightRow(parts, texels + 8, static_cast<int>(width) - 2);
    // There is no liquid along the border, and its light fades into that around the map.
    for (const std::ptrdiff_t x : {std::ptrdiff_t{0}, std::ptrdiff_t{1}, 2 * width - 2, 2 * width - 1}) {
      std::fill_n(texels + 4 * x, 3, 1.0F);
      texels[4 * x + 3] = kNoLiquid;
    }
  }
}

}  // namespace sluice::render
