#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "sluice/core/particle_snapshot.h"
#include "sluice/core/ray.h"

namespace sluice::render {

/// The fluid along a line of sight.
struct PickedFluid {
  Eigen::Vector3f position;  ///< Where the ray first enters it, m.
  double depth = 0;          ///< Eye depth of `position`, m.
  double thickness = 0;      ///< Length of the ray within it, all of its parts together, m.
  Eigen::Vector3f velocity;  ///< m/s, of the particles about `position`, each with the weight of the kernel.
  double density = 0;        ///< kg/m³, likewise.
  std::uint32_t fluid = 0;   ///< Of the particle nearest to `position`.
};

/// Finds the fluid that a ray meets in front of its origin, from the particles alone: where the share of space that
/// they fill (the colour field, with a Wendland C2 kernel of support 2 d) passes one half. A particle too far from
/// others to fill half of anything counts as the sphere that it is drawn as. Bodies in front do not matter.
/// Thread-safe. Time grows with the number of particles: about 2 ns for each.
std::optional<PickedFluid> pickFluid(const core::ParticleSnapshot& particles, const core::Ray& ray);

}  // namespace sluice::render
