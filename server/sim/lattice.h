#pragma once

#include "kernel.h"

namespace sluice::sim {

/// Σ_j d^D W(|x_ij|) over an infinite cubic (square) lattice of spacing d in D = 3 (2) dimensions, the particle itself
/// included. It is 1 only by chance (cubic spline, H = 2d); the rest state is right when a particle's volume is d^D
/// divided by this.
double latticeDensity(KernelKind kernel, double spacing, double support, int dimensions = 3);

/// Volume that a particle represents, m³ (m² in two dimensions): d^D divided by the lattice density, so that a lattice
/// at rest has exactly the rest density ("self-consistent mass").
double particleVolume(KernelKind kernel, double spacing, double support, int dimensions = 3);

/// Normalised density, without any boundary, in the lowest layer of a lattice that fills a half-space.
double halfSpaceDensity(KernelKind kernel, double spacing, double support, int dimensions = 3);

/// What the friction 2(D + 2) ν Σ_j V_j (v_ij·x_ij)/(|x_ij|² + 0.01 H²) ∇W_ij amounts to on a lattice, over the ν that
/// it stands for: of shear along the rows, the mean over how far they have slid. Less than 1, because sums over few
/// neighbours are no integrals and for the 0.01 H².
double viscosityDeficit(KernelKind kernel, double spacing, double support, int dimensions = 3);

/// The largest eigenvalue of the pressure operator D Dᵀ (see JacobiSolve) on a lattice, over its diagonal: relaxed
/// Jacobi iteration converges for relaxations below 2 divided by this.
double pressureStiffness(KernelKind kernel, double spacing, double support, int dimensions = 3);

}  // namespace sluice::sim
