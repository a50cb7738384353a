#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "jacobi_solve.h"
#include "step_context.h"

namespace sluice::sim {

/// Parameters of a density solve, as its solver's scene message has them.
struct DensitySolveSettings {
  double tolerance = 0;  ///< Mean compression, relative to the rest density.
  std::uint32_t maxIterations = 100;
  double relaxation = 0.5;
  double warmStart = 0;              ///< Share of the last step's pressures that it starts from.
  std::string_view iterationsField;  ///< Path of the field that grants more iterations.
};

/// Velocities after which nothing is compressed at the end of the step. Sets the step's trouble where the iterations
/// ran out with a mean compression of more than one tolerance above what the step has found, or of more than 1 % (or
/// ten tolerances), and where some particle would be compressed beyond the step's limit.
void solveDensity(JacobiSolve& solve, const DensitySolveSettings& settings, const std::vector<float>& factor,
                  StepContext& step);

/// Multiplies impulses by `scale`, to start a solve from.
void warmStart(std::vector<float>& impulse, double scale, const StepContext& step);

}  // namespace sluice::sim
