#include "sluice/sim/stage_cost.h"

#include "pair_loops.h"
#include "particles.h"

namespace sluice::sim {

namespace {

constexpr double kVector = sizeof(Float4);
constexpr double kScalar = sizeof(float);

/// One Jacobi iteration: the velocities that the impulses lead to, then the impulses that these ask for.
StageCost iteration(const PairCounts& pairs) {
  const double list = sizeof(PairGroup) * pairs.groups;
  StageCost cost;
  // Impulse, gradient sum and velocity in, velocity out.
  cost.bytes += list + 4 * kVector;
  cost.flops += 6 * pairs.neighbours + 9;
  // Velocity, gradient sum, factor, density; impulse in and out.
  cost.bytes += list + 4 * kVector + 2 * kScalar;
  cost.flops += 6 * pairs.neighbours + 11;
  return cost;
}

StageCost times(double count, const StageCost& cost) { return {count * cost.bytes, count * cost.flops}; }

StageCost search(const PairCounts& pairs) {
  // Cells are as wide as the support: of 27 cells' particles, those in a ball of that radius are neighbours.
  const double candidates = pairs.neighbours * 27 / 4.19;
  constexpr double kDistance = 9;  // differences, squares, sum, comparison
  constexpr double kPair = 24;     // root, both kernels, gradient, its rounding, and the sums
  // A position in; the pairs and five sums out.
  return {kVector + sizeof(PairGroup) * pairs.groups + kVector + 2 * kScalar + 4,
          kDistance * candidates + kPair * pairs.neighbours};
}

}  // namespace

PairCounts countPairs(const core::ParticleSnapshot& particles) {
  PairCounts counts;
  if (particles.neighbours.empty()) return counts;
  for (const std::uint16_t neighbours : particles.neighbours) {
    counts.neighbours += neighbours;
    counts.groups += (neighbours + 3) / 4;
  }
  const auto size = static_cast<double>(particles.neighbours.size());
  return {counts.neighbours / size, counts.groups / size};
}

std::optional<StageCost> stageCost(Stage stage, const PairCounts& pairs, const core::StepStatistics& step) {
  switch (stage) {
    case Stage::DivergenceSolve:
      return times(step.divergenceIterations, iteration(pairs));
    case Stage::DensitySolve:
      return times(step.densityIterations, iteration(pairs));
    case Stage::Viscosity:
      // Position and velocity in, velocity out, which then takes the other's place.
      return StageCost{sizeof(PairGroup) * pairs.groups + 3 * kVector, 25 * pairs.neighbours};
    case Stage::Gravity:
      return StageCost{2 * kVector, 3};
    case Stage::Move:
      // Once to look for what cannot be right, once to move.
      return StageCost{3 * kVector + 2 * kVector, 14};
    case Stage::Neighbours:
      return search(pairs);
    case Stage::Factors:
      return StageCost{kVector + 4 * kScalar + 2, 8};
    case Stage::DensityError:
      return StageCost{kScalar, 3};
    default:
      return std::nullopt;
  }
}

}  // namespace sluice::sim
