#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sluice/core/particle_snapshot.h"
#include "sluice/v1/scene.pb.h"
#include "splat_selection.h"
#include "view_geometry.h"

namespace sluice::render {

/// The noise around one particle: a disc in space about it, parallel to the picture, with a piece of gradient noise of
/// its own [Perlin 2002, Improving Noise]. As the disc goes with the particle, so does the noise.
///
/// A point of the disc at l = (x, y), in radii from its centre, is at the place
///   (turnX·l_x − turnY·l_y + originX, turnY·l_x + turnX·l_y + originY)
/// of a lattice, at every point of which stands a gradient that only the point and `seed` decide. No two particles
/// share a lattice, so that no pattern ever repeats.
struct NoiseSprite {
  float x, y, z;           ///< Centre in view space, m.
  float radius;            ///< m.
  float turnX, turnY;      ///< Cosine and sine of its turn, times the cells in a radius.
  float originX, originY;  ///< Above 0 all over the disc.
  std::uint32_t seed;
  float height;    ///< Factor of the noise, m.
  float violence;  ///< 0 to 1.
};

/// Cells of the lattice in the radius of the first octave. With two, and a kernel that is narrow, a sprite shows one or
/// two waves.
inline constexpr float kNoiseCellsPerRadius = 2.0F;

/// Root mean square of the noise's slope, per cell, with gradients that are even over the square [−1, 1]²; a test holds
/// the noise to it.
inline constexpr float kNoiseSlope = 0.722F;
/// The same of the noise itself.
inline constexpr float kNoiseHeight = 0.176F;

/// A number that looks random, for each id another: "lowbias32" of C. Wellons' hash prospector.
std::uint32_t scrambled(std::uint32_t id);

/// The octave of a particle. An octave has as many particles as let each cover as much of the surface.
unsigned octaveOf(std::uint32_t hash, const v1::Noise& noise);

/// Root mean square of the height of noise of violent particles where all octaves are shown, m.
float typicalNoise(const v1::Noise& noise, float spacing);

/// Sprites of all particles that are drawn as splats and not behind the near depth, in their order. `violence` has one
/// number for each particle of the snapshot, or none: all are calm. Particles without ids are told by their places in
/// the arrays.
std::vector<NoiseSprite> makeNoiseSprites(const core::ParticleSnapshot& particles, const SplatSelection& selection,
                                          std::span<const float> violence, const v1::Noise& noise,
                                          const ViewGeometry& target, float nearDepth);

}  // namespace sluice::render
