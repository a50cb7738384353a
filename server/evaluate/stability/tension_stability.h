#pragma once

#include <vector>

#include "stability/stability_job.h"

namespace sluice::evaluate {

/// Flows whose pressure is below 0, with every solver: a rotating square, a thin sheet that turns, Taylor–Green
/// vortices. Where pressures are clamped at 0 fluid comes apart, and where they are not particles clump, the tensile
/// instability [Swegle et al. 1995]. Rows have density_lost and nearest besides, and a message that names what
/// happened.
std::vector<StabilityJob> tensionJobs(int threads);

/// What tension does to particles.
struct TensileState {
  double densityLost = 0;  ///< Share of the mean density.
  double nearest = 1;      ///< Mean distance of a particle to its nearest neighbour, spacings.

  /// Names it; empty where it is neither.
  std::string text(bool clamped) const;
};

/// Of a cloud of particles that started with that mean density, kg/m³, on a square lattice.
TensileState tensileState(const core::ParticleSnapshot& particles, double meanDensityBefore);

}  // namespace sluice::evaluate
