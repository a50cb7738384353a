#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/scene.pb.h"
#include "splat_ellipsoids.h"

namespace sluice::render {

/// What a particle is part of.
enum class SplatRole : std::uint8_t {
  Surface,   ///< Drawn into depth and thickness.
  Interior,  ///< So deep inside that other particles hide it from everywhere: drawn into thickness alone.
  Spray,     ///< Far from the rest: a drop of its own.
};

/// What a particle of the surface is drawn as.
enum class SplatShape : std::uint8_t {
  Sphere,
  Ellipsoid,
  /// A disc at the particle's eye depth, parallel to the picture [CS08: Cords & Staadt 2008, Instant Liquids]. Eq. (2)
  /// there, r_x = r·W·√(p₁₁²+…)/w', is its *diameter* in pixels under Eq. (1)'s mapping; a disc of radius r is meant.
  Disc,
};

/// How the particles of one snapshot are drawn, whatever the camera. Empty arrays stand for the plain case: every
/// particle is part of the surface, and every splat has the same radius.
struct SplatModel {
  SplatShape shape = SplatShape::Sphere;
  std::vector<SplatRole> roles;
  std::vector<float> radii;                ///< m.
  std::vector<SplatEllipsoid> ellipsoids;  ///< One for every particle where that is the shape.
  /// Radii that depend on density, by the particles' ids, for the snapshot that comes next.
  std::unordered_map<std::uint32_t, float> radiusOfId;

  SplatRole role(std::size_t i) const { return roles.empty() ? SplatRole::Surface : roles[i]; }
  float radius(std::size_t i, float usual) const { return radii.empty() ? usual : radii[i]; }
};

/// Radius of a ball of a particle's volume d³, in particle spacings: (3/4π)^⅓.
inline constexpr float kBallOfParticle = 0.62035049F;

/// Change of a radius below which a particle keeps the one it had: a step of a tenth is not seen as a jump, and smaller
/// changes of density, which come and go with every time step, are not seen at all.
inline constexpr float kRadiusHysteresis = 0.1F;

/// Radius for a particle of `density`, in rest densities: R·clamp(density^(−⅓), 1, 1.6) [CS08, section 5]; a particle
/// that is alone, and therefore of density `alone`, becomes a ball of its volume.
float radiusByDensity(float density, float alone, float radius, float spacing);

/// Density that a particle has without any other, in rest densities: W(0)·d³ = 8/π·(d/H)³ of a cubic spline, with a
/// support H of two spacings d where the source does not tell.
float aloneDensity(const core::ParticleSnapshot& particles);

/// What the settings make of a snapshot. What they need and the snapshot does not have is left out. `previous` is the
/// model of the snapshot before, whose radii particles of the same ids keep for small changes. Uses the OpenMP team of
/// the calling thread; the result is the same for any number of threads.
SplatModel makeSplatModel(const core::ParticleSnapshot& particles, const v1::Splats& splats,
                          const SplatModel& previous = {});

}  // namespace sluice::render
