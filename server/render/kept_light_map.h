#pragma once

#include <cstdint>
#include <vector>

#include "light_map.h"
#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Whether sunlight ends at it.
bool castsFullShadow(const v1::Liquid& liquid);

/// The light map of the last particles, made anew when these, the sun, or what matters of a liquid has changed.
class KeptLightMap {
 public:
  /// `liquids` is their number. `sequence` 0 stands for particles that are always new.
  void update(const core::ParticleSnapshot& particles, const v1::Scene& scene, std::size_t liquids);

  const LightMap& map() const { return mapper_.map(); }
  /// Grows with every new map.
  std::uint64_t version() const { return version_; }

 private:
  /// What a map is made of.
  struct Ingredients {
    std::uint64_t sequence = 0;
    float spacing = 0;
    float floorHeight = 0;
    Eigen::Vector3f sun = Eigen::Vector3f::Zero();
    float caustics = 0;
    float surfaceDeviation = 0;
    std::vector<LitLiquid> liquids;

    bool operator==(const Ingredients&) const = default;
  };

  LightMapper mapper_;
  Ingredients madeOf_;
  std::uint64_t version_ = 0;
};

}  // namespace sluice::render
