#pragma once

#include <vector>

#include "step_context.h"

namespace sluice::sim {

/// α_i of every particle, m²: how far a unit of pressure impulse goes, the inverse of the diagonal that JacobiSolve
/// names. 0 where a particle has no neighbour to push against.
void computePressureFactors(const StepContext& step, std::vector<float>& factor);

}  // namespace sluice::sim
