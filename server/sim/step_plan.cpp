#include "sluice/sim/step_plan.h"

#include <algorithm>

#include "sluice/core/check.h"

namespace sluice::sim {

namespace {

struct StageDescription {
  Stage stage;
  std::string_view name;
  std::vector<std::string> reads;
  std::vector<std::string> writes;
};

/// In the order in which they run.
const std::vector<StageDescription>& descriptions() {
  static const std::vector<StageDescription> all{
      {Stage::TimeStep, "time step", {"velocities"}, {"time step"}},
      {Stage::DivergenceSolve, "divergence solve", {"pairs", "factors"}, {"velocities", "divergence impulses"}},
      {Stage::SurfaceTension, "surface tension", {"pairs", "positions", "densities"}, {"velocities"}},
      {Stage::Adhesion, "adhesion", {"positions", "cells", "boundary particles"}, {"velocities", "bodies' velocities"}},
      {Stage::Micropolar, "micropolar", {"pairs", "positions", "spins"}, {"velocities", "spins"}},
      {Stage::Viscosity, "viscosity", {"pairs", "positions"}, {"velocities"}},
      {Stage::ImplicitViscosity, "implicit viscosity", {"pairs", "positions"}, {"velocities"}},
      {Stage::BodyFriction, "body friction", {"contacts"}, {"velocities", "bodies' velocities"}},
      {Stage::Gravity, "gravity", {}, {"velocities"}},
      {Stage::Touch, "touch", {"positions"}, {"velocities"}},
      {Stage::DensitySolve, "density solve", {"pairs", "densities", "factors"}, {"velocities", "density impulses"}},
      {Stage::EquationOfState, "equation of state", {"pairs", "compressions"}, {"velocities", "compressions"}},
      {Stage::RigidBodies, "rigid bodies", {"bodies' velocities"}, {"poses"}},
      {Stage::Move, "move", {"velocities"}, {"positions"}},
      {Stage::Drains, "drains", {"positions"}, {"particles"}},
      {Stage::Emitters, "emitters", {"positions"}, {"particles", "positions", "velocities"}},
      {Stage::Sort, "sort", {"positions"}, {"cells", "order of the particles"}},
      {Stage::Neighbours, "neighbours", {"positions", "cells"}, {"pairs", "densities", "gradient sums"}},
      {Stage::Boundary, "boundary", {"positions", "boundary particles"}, {"densities", "gradient sums"}},
      {Stage::MovingBoundary, "moving boundary", {"positions", "poses"}, {"densities", "gradient sums", "contacts"}},
      {Stage::PositionSolve,
       "position solve",
       {"pairs", "densities"},
       {"positions", "velocities", "pairs", "densities"}},
      {Stage::Factors, "factors", {"gradient sums"}, {"factors"}},
      {Stage::DensityError, "density error", {"densities"}, {"density error"}},
  };
  return all;
}

const StageDescription& describe(Stage stage) {
  const auto& all = descriptions();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& d) { return d.stage == stage; });
  SLUICE_CHECK(found != all.end());
  return *found;
}

bool isZero(const v1::Vec3& v) { return v.x() == 0 && v.y() == 0 && v.z() == 0; }

bool isViscous(const v1::Fluid& fluid) { return fluid.viscosity() > 0; }

/// Whether a stage is one of the methods that the scene has chosen.
bool belongs(Stage stage, const v1::Simulation& simulation, const StepTraits& traits) {
  const auto solver = simulation.pressure_solver_case();
  const bool dfsph = solver == v1::Simulation::kDfsph || solver == v1::Simulation::PRESSURE_SOLVER_NOT_SET;
  const bool iisph = solver == v1::Simulation::kIisph;
  switch (stage) {
    case Stage::DivergenceSolve:
      return dfsph;
    case Stage::DensitySolve:
    case Stage::Factors:
      return dfsph || iisph;
    case Stage::EquationOfState:
      return solver == v1::Simulation::kWcsph;
    case Stage::PositionSolve:
      return solver == v1::Simulation::kPbf;
    case Stage::Viscosity:
      return !traits.implicitViscosity;
    case Stage::ImplicitViscosity:
      return traits.implicitViscosity;
    default:
      return true;
  }
}

/// Stages over pairs, none of which there is in free flight. A micropolar fluid's spins decay even then.
bool isOverPairs(Stage stage) {
  switch (stage) {
    case Stage::TimeStep:
    case Stage::Micropolar:
    case Stage::BodyFriction:
    case Stage::Gravity:
    case Stage::Touch:
    case Stage::RigidBodies:
    case Stage::Move:
    case Stage::Drains:
    case Stage::Emitters:
    case Stage::MovingBoundary:
    case Stage::Sort:
    case Stage::DensityError:
      return false;
    default:
      return true;
  }
}

/// Stages that leave the particles sorted, with their pairs: needed where a step without any before brings some.
bool endsStep(Stage stage) {
  switch (stage) {
    case Stage::Sort:
    case Stage::Neighbours:
    case Stage::Boundary:
    case Stage::Factors:
    case Stage::DensityError:
      return true;
    default:
      return false;
  }
}

/// Stages that move bodies on where there is no particle yet, or no longer one.
bool movesBodies(Stage stage) { return stage == Stage::Gravity || stage == Stage::RigidBodies; }

bool hasEmitters(const v1::Fluid& fluid) { return fluid.emitters_size() > 0; }

std::string_view reasonWithoutAdhesion(const v1::Simulation& simulation, const StepTraits& traits) {
  const bool standing = simulation.wall_adhesion() > 0 || traits.standingAdhere;
  if (!standing && !traits.movingAdhere) return "no wall or body has any";
  const bool near = (standing && traits.boundaryInReach) || (traits.movingAdhere && traits.bodiesInReach);
  return near ? "" : "no particle is near what has it";
}

/// Why a stage has nothing to do; empty when it has.
std::string_view reasonToLeaveOut(Stage stage, const v1::Simulation& simulation, const StepTraits& traits) {
  if (stage == Stage::Emitters) {
    if (std::ranges::none_of(simulation.fluids(), hasEmitters)) return "none";
    return traits.emitting ? "" : "all have ended";
  }
  if (stage == Stage::Drains && simulation.drains_size() == 0) return "none";
  if (traits.particles == 0 && !(traits.emitting && endsStep(stage)) && !(traits.bodiesMove && movesBodies(stage))) {
    return "there are no particles";
  }
  switch (stage) {
    case Stage::DivergenceSolve:
      if (!simulation.dfsph().divergence_solve()) return "switched off";
      break;
    case Stage::SurfaceTension:
      if (!simulation.has_surface_tension()) return "not asked for";
      if (simulation.surface_tension().tension() == 0) return "the tension is 0";
      break;
    case Stage::Adhesion:
      if (const std::string_view reason = reasonWithoutAdhesion(simulation, traits); !reason.empty()) return reason;
      break;
    case Stage::Micropolar:
      if (!simulation.has_micropolar()) return "not asked for";
      if (simulation.micropolar().transfer() == 0) return "the transfer is 0";
      break;
    case Stage::Viscosity:
    case Stage::ImplicitViscosity:
      if (std::ranges::none_of(simulation.fluids(), isViscous)) return "the viscosity is 0";
      break;
    case Stage::Gravity:
      if (isZero(simulation.gravity()) && !traits.forceField) return "gravity is 0";
      break;
    case Stage::Touch:
      if (!traits.touched) return "nobody touches the fluid";
      break;
    case Stage::BodyFriction:
      if (!traits.bodiesRub) return "no body has friction";
      if (!traits.bodiesInReach) return "no particle is near such a body";
      break;
    case Stage::RigidBodies:
      if (!traits.bodiesMove) return "none floats or is driven";
      break;
    case Stage::MovingBoundary:
      if (!traits.bodiesMove && !traits.bodiesRub) return "no body moves or has friction";
      if (!traits.bodiesInReach) return "no particle is near such a body";
      break;
    case Stage::Boundary:
      if (!traits.boundaryInReach) return "no particle is near a wall";
      break;
    default:
      break;
  }
  return traits.freeFlight && isOverPairs(stage) ? "no particle can meet another in this step" : "";
}

}  // namespace

std::string_view stageName(Stage stage) { return describe(stage).name; }

bool StepPlan::contains(Stage stage) const { return std::find(stages.begin(), stages.end(), stage) != stages.end(); }

StepPlan planStep(const v1::Simulation& simulation, const StepTraits& traits) {
  StepPlan plan;
  for (const StageDescription& description : descriptions()) {
    if (!belongs(description.stage, simulation, traits)) continue;
    const std::string_view reason = reasonToLeaveOut(description.stage, simulation, traits);
    if (reason.empty()) {
      plan.stages.push_back(description.stage);
    } else {
      plan.leftOut.push_back({std::string(description.name), std::string(reason)});
    }
  }
  return plan;
}

core::Plan describe(const StepPlan& plan) {
  core::Plan described;
  for (const Stage stage : plan.stages) {
    const StageDescription& description = describe(stage);
    described.stages.push_back({std::string(description.name), description.reads, description.writes});
  }
  described.leftOut = plan.leftOut;
  return described;
}

}  // namespace sluice::sim
