#pragma once

#include "kernel.h"

namespace sluice::sim {

/// Σ_j d³ W(|x_ij|) over an infinite cubic lattice of spacing d, the particle itself included. It is 1 only by chance
/// (cubic spline, H = 2d); the rest state is right when a particle's volume is d³ divided by this.
double latticeDensity(KernelKind kernel, double spacing, double support);

/// Volume that a particle represents, m³: d³ divided by the lattice density, so that a lattice at rest has exactly the
/// rest density ("self-consistent mass").
double particleVolume(KernelKind kernel, double spacing, double support);

/// Normalised density, without any boundary, in the lowest layer of a lattice that fills a half-space.
double halfSpaceDensity(KernelKind kernel, double spacing, double support);

}  // namespace sluice::sim
