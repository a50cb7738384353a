#pragma once

#include "kernel.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// How a scene's fluid is cut into particles, and what smooths between them. It does not change while a scene runs.
struct Discretisation {
  int dimensions = 3;  ///< D: 2 where the scene is planar.
  KernelKind kernel = KernelKind::CubicSpline;
  double spacing = 0;  ///< d, m.
  double support = 0;  ///< H, m.
  double volume = 0;  ///< V of a particle, m³ (m² in two dimensions): a lattice at rest has exactly the rest density.
  /// What a relaxation of Jacobi iteration that suits the cubic spline of two spacings is multiplied by, at most 1: the
  /// more neighbours a particle has, the stiffer are all of them together against one alone.
  double relaxationScale = 1;

  /// What viscosities are multiplied by to make up for the sums over pairs, see viscosityDeficit.
  double viscosityScale = 1;

  double smoothingLength() const { return support / 2; }  ///< h, m.
};

Discretisation discretisationOf(const v1::Simulation& simulation);

}  // namespace sluice::sim
