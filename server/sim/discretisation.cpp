#include "discretisation.h"

#include <algorithm>

#include "lattice.h"

namespace sluice::sim {

Discretisation discretisationOf(const v1::Simulation& simulation) {
  Discretisation d;
  d.dimensions = simulation.planar() ? 2 : 3;
  d.spacing = simulation.particle_spacing();
  if (simulation.has_wendland_c2()) {
    d.kernel = KernelKind::WendlandC2;
    d.support = simulation.wendland_c2().support_in_spacings() * d.spacing;
  } else {
    d.kernel = KernelKind::CubicSpline;
    d.support = simulation.cubic_spline().support_in_spacings() * d.spacing;
  }
  d.volume = particleVolume(d.kernel, d.spacing, d.support, d.dimensions);
  d.viscosityScale = 1 / viscosityDeficit(d.kernel, d.spacing, d.support, d.dimensions);
  d.relaxationScale = std::min(1.0, pressureStiffness(KernelKind::CubicSpline, 1, 2, 3) /
                                        pressureStiffness(d.kernel, d.spacing, d.support, d.dimensions));
  return d;
}

}  // namespace sluice::sim
