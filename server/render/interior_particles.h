#pragma once

#include <span>
#include <vector>

#include "sluice/core/particle_snapshot.h"

namespace sluice::render {

/// Which particles are so deep inside the liquid that no line of sight from outside meets their splat: 1 for those.
///
/// Such a particle has a full neighbourhood itself, and so has every particle around it up to twice the spacing and
/// more: on a lattice the outermost three layers count as surface. A neighbourhood is full from three quarters of
/// (4/3)π(H/d)³ on, 25 for a support H of two spacings d: a particle inside has 26 to 32 there, one on a flat surface
/// 17 to 22. Counts alone do not do, and one layer less would: in a breaking column some of the full are seen.
/// Walls do not count as neighbours, because the liquid at a wall is seen through it.
///
/// The snapshot must have neighbour counts. Uses the OpenMP team of the calling thread.
std::vector<char> findInterior(const core::ParticleSnapshot& particles);

/// Splats smaller than this, in particle spacings, leave gaps through which one sees deep into the liquid: in a cubic
/// lattice channels open below 1/√2. Nothing is interior then.
inline constexpr double kLeastRadiusOfInterior = 0.75;

}  // namespace sluice::render
