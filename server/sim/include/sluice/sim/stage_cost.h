#pragma once

#include <optional>

#include "sluice/core/particle_snapshot.h"
#include "sluice/sim/step_plan.h"

namespace sluice::sim {

/// Means over the particles of a scene.
struct PairCounts {
  double neighbours = 0;
  double groups = 0;  ///< Of four neighbours, as the loops take them.
};

/// From the numbers of neighbours of a snapshot that has them.
PairCounts countPairs(const core::ParticleSnapshot& particles);

/// What a stage must move and compute for one particle in one step.
struct StageCost {
  double bytes = 0;  ///< Between memory and caches: every array once in each loop over it, gathers of neighbours taken
                     ///< to hit a cache.
  double flops = 0;  ///< Additions, multiplications, divisions and roots of single precision that count.
};

/// The model that a roofline [Williams et al. 2009] compares with the machine: counted from the loops over pairs as
/// they are written, for three dimensions, one fluid, and the iterations of that step. None for stages that have no
/// such loop or whose work is another scene's.
std::optional<StageCost> stageCost(Stage stage, const PairCounts& pairs, const core::StepStatistics& step);

}  // namespace sluice::sim
