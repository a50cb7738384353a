#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "caustics.h"
#include "light_surface.h"
#include "light_view.h"

namespace sluice::render {

/// What liquid makes of the sunlight behind it.
struct LightMap {
  LightGrid grid;  ///< Of no cells where no particle stands in sunlight.
  /// Row by row, for every cell: the factor of sunlight behind the liquid, red, green, blue, 1 where there is none; and
  /// the depth along the light of the liquid's first surface, m, or kNoLiquid. What is nearer to the sun stays lit.
  std::vector<float> texels;
};

struct SunlightSettings {
  Eigen::Vector3f sun = Eigen::Vector3f::UnitY();  ///< Unit vector towards it; above the horizon.
  float caustics = 0;                              ///< Strength, 0 to 1; 0 leaves refraction out.
  float surfaceDeviation = 0;                      ///< Of the Gaussian that smooths the surface, m.
  std::span<const float> receiver = {};            ///< See CausticsInput; of the grid that cover() gives.
};

/// Makes light maps, and keeps its memory from one to the next. Uses the OpenMP team of the calling thread; the result
/// is the same for any number of threads.
class LightMapper {
 public:
  /// Sunlight flatter than this shades half the scene; about 3 degrees.
  static constexpr float kLeastRise = 0.05F;

  /// The cells that the liquid is drawn into; those of the light map are half as wide.
  static LightGrid cover(const SunlitParticles& particles, const Eigen::Vector3f& sun, bool caustics);

  /// `liquids`: one for each index in particles.fluids; particles of further fluids count as of the first.
  const LightMap& make(const SunlitParticles& particles, std::span<const LitLiquid> liquids,
                       const SunlightSettings& settings);

  const LightMap& map() const { return map_; }

 private:
  void transmit(std::span<const LitLiquid> liquids, float spacing, float rise, const LightGrid& grid);
  std::span<const float> focus(const SunlitParticles& particles, std::span<const LitLiquid> liquids,
                               const SunlightSettings& settings, const LightGrid& grid);
  void assemble(std::span<const float> focus, float caustics, const LightGrid& grid);

  LightSurface surface_;
  Caustics caustics_;
  std::vector<float> transmitted_[3];
  std::vector<float> inverseIndex_;
  LightMap map_;
};

}  // namespace sluice::render
