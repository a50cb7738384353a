#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "sluice/core/plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// The stages of a time step. A step leaves the particles sorted, with the pairs and densities of where they are.
enum class Stage {
  TimeStep,         ///< Choose the length of the step.
  DivergenceSolve,  ///< Pressure impulses that stop compression.
  Viscosity,        ///< Explicit viscosity.
  Gravity,
  DensitySolve,  ///< Pressure impulses that keep the density at rest after the move.
  Move,          ///< Refuse or take the step: x += v dt.
  Sort,          ///< Reorder the particles by cell.
  Neighbours,    ///< Find the pairs; densities and gradient sums.
  Boundary,      ///< The boundary's share of those sums.
  Factors,       ///< Pressure factors, and the density error reached.
};

/// What a plan needs to know of the particles.
struct StepTraits {
  std::size_t particles = 0;
  /// A particle may come within the support radius of the container in this step.
  bool boundaryInReach = true;
};

struct StepPlan {
  std::vector<Stage> stages;
  std::vector<core::LeftOut> leftOut;

  bool contains(Stage stage) const;
  bool operator==(const StepPlan&) const = default;
};

std::string_view stageName(Stage stage);

/// The stages that a step runs, in order, and those that it leaves out, with the reason. A pure function: what is left
/// out would not change a bit of the particles, except where the scene itself switches it off.
StepPlan planStep(const v1::Simulation& simulation, const StepTraits& traits);

/// For people to read, with what each stage reads and writes; `buffers` is left empty.
core::Plan describe(const StepPlan& plan);

}  // namespace sluice::sim
