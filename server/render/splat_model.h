#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace sluice::render {

/// What a particle is part of.
enum class SplatRole : std::uint8_t {
  Surface,   ///< Drawn into depth and thickness.
  Interior,  ///< So deep inside that other particles hide it from everywhere: drawn into thickness alone.
  Spray,     ///< Far from the rest: a drop of its own.
};

/// How the particles of one snapshot are drawn, whatever the camera. Empty arrays stand for the plain case: every
/// particle is part of the surface, and every splat has the same radius.
struct SplatModel {
  std::vector<SplatRole> roles;
  std::vector<float> radii;  ///< m.

  SplatRole role(std::size_t i) const { return roles.empty() ? SplatRole::Surface : roles[i]; }
  float radius(std::size_t i, float usual) const { return radii.empty() ? usual : radii[i]; }
};

}  // namespace sluice::render
