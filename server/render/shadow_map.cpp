#include "shadow_map.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace sluice::render {

namespace {

constexpr auto kCells = static_cast<std::size_t>(ShadowMap::kEdge);

/// Sunlight flatter than this casts shadows over the whole floor that are not worth drawing; about 3 degrees.
constexpr float kLeastRise = 0.05F;

/// Cells left free around the shadow, into which smoothing spreads it.
constexpr float kMargin = 6.0F;

/// Mean of three neighbours along one axis, four times: close to a Gaussian of σ = 1.6 cells.
void smooth(std::vector<float>& cells) {
  std::vector<float> result(cells.size());
  for (int round = 0; round < 4; ++round) {
    for (const std::size_t step : {std::size_t{1}, kCells}) {
      std::ranges::fill(result, 0.0F);
      for (std::size_t i = kCells; i + kCells < cells.size(); ++i) {
        result[i] = (cells[i - step] + cells[i] + cells[i + step]) * (1.0F / 3.0F);
      }
      cells.swap(result);
    }
  }
}

}  // namespace

ShadowMap castShadow(std::span<const Eigen::Vector3f> positions, float spacing, float floorHeight,
                     const Eigen::Vector3f& sun) {
  ShadowMap map;
  if (sun.y() < kLeastRise) return map;
  const Eigen::Vector2f shift(sun.x() / sun.y(), sun.z() / sun.y());
  std::vector<Eigen::Vector2f> feet;
  feet.reserve(positions.size());
  Eigen::AlignedBox2f bounds;
  for (const Eigen::Vector3f& p : positions) {
    const float height = p.y() - floorHeight;
    if (height < 0.0F) continue;
    feet.emplace_back(Eigen::Vector2f(p.x(), p.z()) - height * shift);
    bounds.extend(feet.back());
  }
  if (feet.empty()) return map;

  // Cells no smaller than the spacing, or single particles would show.
  const float extent = std::max(bounds.sizes().maxCoeff(), 1e-6F);
  const float cell = std::max(extent / (static_cast<float>(ShadowMap::kEdge) - 2.0F * kMargin), spacing);
  map.edge = cell * static_cast<float>(ShadowMap::kEdge);
  map.corner = bounds.center() - Eigen::Vector2f::Constant(0.5F * map.edge);
  map.thickness.assign(kCells * kCells, 0.0F);

  // A beam of one cell's area on the floor is narrower by the sun's rise across itself.
  const float thicknessOfParticle = spacing * spacing * spacing / (cell * cell * sun.y());
  for (const Eigen::Vector2f& foot : feet) {
    const Eigen::Vector2f place = (foot - map.corner) / cell - Eigen::Vector2f::Constant(0.5F);
    const Eigen::Vector2f low = place.array().floor();
    const Eigen::Vector2f weight = place - low;
    const auto index = static_cast<std::size_t>(low.y()) * kCells + static_cast<std::size_t>(low.x());
    map.thickness[index] += thicknessOfParticle * (1.0F - weight.x()) * (1.0F - weight.y());
    map.thickness[index + 1] += thicknessOfParticle * weight.x() * (1.0F - weight.y());
    map.thickness[index + kCells] += thicknessOfParticle * (1.0F - weight.x()) * weight.y();
    map.thickness[index + kCells + 1] += thicknessOfParticle * weight.x() * weight.y();
  }
  smooth(map.thickness);
  return map;
}

}  // namespace sluice::render
