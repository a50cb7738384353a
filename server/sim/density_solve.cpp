#include "density_solve.h"

#include <algorithm>
#include <sstream>

namespace sluice::sim {

namespace {

// A mean compression above this, left by a solve that has used up its iterations, is no fluid's.
constexpr double kSaneCompression = 0.01;

// Fluids further apart in rest density than this are worth a word where a density solve fails.
constexpr double kDemandingRatio = 10;

struct Compression {
  double sum = 0;
  Compression& operator+=(const Compression& other) {
    sum += other.sum;
    return *this;
  }
};

/// Mean compression of the particles where the step begins.
double compressionFound(const StepContext& step) {
  const std::vector<float>& density = step.lists.density();
  const auto found = step.team.sumOverChunks<Compression>(density.size(), [&](const Chunk& chunk) {
    Compression part;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) part.sum += std::max(density[i] - 1.0F, 0.0F);
    return part;
  });
  return found.sum / static_cast<double>(std::max<std::size_t>(density.size(), 1));
}

/// The mean compression up to which a step whose iterations are used up is taken: one tolerance more than the step has
/// `found`, but none that no fluid has. What a step adds, a shorter one adds less of: this shortens steps that need
/// more iterations than they have before what they leave adds up, and never for what was there already.
double acceptedCompression(const SolveGoal& goal, double found) {
  return std::min(std::max(kSaneCompression, 10 * goal.tolerance), found + goal.tolerance);
}

void judge(const SolveOutcome& outcome, const SolveGoal& goal, std::string_view iterationsField, StepContext& step) {
  std::ostringstream text;
  const bool isExhausted = outcome.iterations == goal.maxIterations && outcome.meanError > goal.tolerance;
  const double found = isExhausted ? compressionFound(step) : 0;
  if (isExhausted && outcome.meanError > acceptedCompression(goal, found)) {
    text << "the density solve left a mean compression of " << 100 * outcome.meanError << " % after "
         << outcome.iterations << " iterations, having found " << 100 * found << " %";
    // Jacobi iteration moves pressure on slowly where a light fluid carries a heavy one.
    if (step.mixture.densityRatio() > kDemandingRatio) {
      text << ", in fluids whose rest densities differ by a factor of " << step.mixture.densityRatio() << " (more "
           << iterationsField << ", or rest densities closer to each other, would help)";
    }
  } else if (outcome.maxError > step.maxCompression) {
    text << "the density solve left a particle compressed by " << 100 * outcome.maxError << " %, more than "
         << "simulation.time_step.max_compression";
  }
  step.trouble = text.str();
}

}  // namespace

void solveDensity(JacobiSolve& solve, const DensitySolveSettings& settings, const std::vector<float>& factor,
                  StepContext& step) {
  SolveGoal goal;
  goal.density = &step.lists.density();
  goal.seconds = step.seconds;
  goal.bodies = step.coupling();
  goal.tolerance = settings.tolerance;
  goal.minIterations = 2;  // [BK17]: one iteration measures, but does not yet couple neighbours.
  goal.maxIterations = settings.maxIterations;
  goal.relaxation = settings.relaxation * step.discretisation.relaxationScale;
  // An impulse is pressure times time: the same pressure over a step of another length.
  const double ratio = step.lastSeconds > 0 ? step.seconds / step.lastSeconds : 0;
  warmStart(step.state.densityImpulse, settings.warmStart * ratio, step);
  const SolveOutcome outcome = solve.run(goal, step.lists, step.mixture.mobility(step.state.fluid), factor,
                                         step.state.velocity, step.state.densityImpulse, step.team);
  step.statistics.densityIterations = outcome.iterations;
  judge(outcome, goal, settings.iterationsField, step);
}

void warmStart(std::vector<float>& impulse, double scale, const StepContext& step) {
  // An impulse that would push the lattice apart by more than a tenth of its spacing is no good guess.
  const double spacing = step.discretisation.spacing;
  const auto largest = static_cast<float>(0.1 * spacing * spacing / step.seconds);
  const auto factor = static_cast<float>(scale);
  step.team.forEachChunk(impulse.size(), [&](const Chunk& chunk) {
    for (std::size_t i = chunk.first; i < chunk.last; ++i) impulse[i] = std::min(impulse[i] * factor, largest);
  });
}

}  // namespace sluice::sim
