#include "kept_light_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frame_uniforms.h"

namespace sluice::render {

namespace {

/// Caustics show every particle of a surface that is smoothed less than by this, d².
constexpr double kLeastSmoothing = 2.0;

LitLiquid lit(const v1::Liquid& liquid) {
  const v1::Vec3& sigma = liquid.absorption();
  return {Eigen::Array3d(sigma.x(), sigma.y(), sigma.z()).cast<float>(), static_cast<float>(liquid.refractive_index()),
          castsFullShadow(liquid)};
}

}  // namespace

bool castsFullShadow(const v1::Liquid& liquid) { return liquid.opaque() || liquid.has_metal(); }

void KeptLightMap::update(const core::ParticleSnapshot& particles, const v1::Scene& scene, std::size_t liquids) {
  const v1::Sun& sun = scene.lighting().sun();
  Ingredients wanted;
  wanted.sequence = particles.sequence;
  wanted.spacing = static_cast<float>(particles.spacing);
  wanted.floorHeight = static_cast<float>(scene.background().floor_height());
  wanted.sun = sunDirection(sun);
  wanted.caustics = static_cast<float>(sun.caustics());
  wanted.surfaceDeviation =
      static_cast<float>(std::sqrt(std::max(scene.look().smoothing().time(), kLeastSmoothing)) * particles.spacing);
  for (std::size_t k = 0; k < liquids; ++k) wanted.liquids.push_back(lit(lookOf(scene, k).liquid()));
  if (wanted.sequence != 0 && wanted == madeOf_) return;
  mapper_.make({particles.positions, particles.fluids, wanted.spacing, wanted.floorHeight}, wanted.liquids,
               {.sun = wanted.sun, .caustics = wanted.caustics, .surfaceDeviation = wanted.surfaceDeviation});
  madeOf_ = std::move(wanted);
  ++version_;
}

}  // namespace sluice::render
