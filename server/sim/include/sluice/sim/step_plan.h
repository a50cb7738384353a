#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "sluice/core/plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// The stages of a time step, of all methods. A step leaves the particles sorted, with the pairs and densities of where
/// they are.
enum class Stage {
  TimeStep,         ///< Choose the length of the step.
  DivergenceSolve,  ///< DFSPH: pressure impulses that stop compression.
  SurfaceTension,
  Adhesion,           ///< Attraction by walls and bodies.
  Micropolar,         ///< Exchange of velocity and spin.
  Viscosity,          ///< Explicit viscosity.
  ImplicitViscosity,  ///< Viscosity by a linear system.
  BodyFriction,       ///< Friction between the fluid and bodies.
  Gravity,
  Touch,            ///< What viewers' hands push and pull.
  DensitySolve,     ///< DFSPH, IISPH: pressure impulses that keep the density at rest after the move.
  EquationOfState,  ///< WCSPH: pressure from density, and how that changes.
  RigidBodies,      ///< Bodies move, by Bullet and by their drivers.
  Move,             ///< Refuse or take the step: x += v dt.
  Drains,           ///< Take out particles that have come into a drain.
  Emitters,         ///< Add the layers of particles that have passed a nozzle's mouth.
  Sort,             ///< Reorder the particles by cell.
  Neighbours,       ///< Find the pairs; densities and gradient sums.
  Boundary,         ///< The boundary's share of those sums.
  MovingBoundary,   ///< The same of bodies that move, and what touches them.
  PositionSolve,    ///< PBF: corrections of the positions.
  Factors,          ///< DFSPH, IISPH: pressure factors.
  DensityError,     ///< How far the densities are from rest.
};

/// What a plan needs to know of the particles.
struct StepTraits {
  std::size_t particles = 0;
  /// A particle may come within the support radius of a wall in this step.
  bool boundaryInReach = true;
  /// No particle has another within the support radius, or can get one in this step.
  bool freeFlight = false;
  bool bodiesMove = false;      ///< A body floats or is driven.
  bool bodiesRub = false;       ///< A body has friction.
  bool bodiesInReach = false;   ///< A particle may come within the support radius of one of these.
  bool standingAdhere = false;  ///< Fluid adheres to a body that stands.
  bool movingAdhere = false;    ///< Fluid adheres to a body that moves or has friction.
  /// A field of force acts besides gravity.
  bool forceField = false;
  bool touched = false;  ///< A hand pushes or pulls.
  /// The step is longer than explicit viscosity is stable in.
  bool implicitViscosity = false;
  /// An emitter may give particles in this step, or has a layer on its way.
  bool emitting = false;
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
