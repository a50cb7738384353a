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
      {Stage::Viscosity, "viscosity", {"pairs", "positions"}, {"velocities"}},
      {Stage::Gravity, "gravity", {}, {"velocities"}},
      {Stage::DensitySolve, "density solve", {"pairs", "densities", "factors"}, {"velocities", "density impulses"}},
      {Stage::Move, "move", {"velocities"}, {"positions"}},
      {Stage::Sort, "sort", {"positions"}, {"cells", "order of the particles"}},
      {Stage::Neighbours, "neighbours", {"positions", "cells"}, {"pairs", "densities", "gradient sums"}},
      {Stage::Boundary, "boundary", {"positions", "boundary particles"}, {"densities", "gradient sums"}},
      {Stage::Factors, "factors", {"gradient sums", "densities"}, {"factors", "density error"}},
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

/// Why a stage has nothing to do; empty when it has.
std::string_view reasonToLeaveOut(Stage stage, const v1::Simulation& simulation, const StepTraits& traits) {
  if (traits.particles == 0) return "there are no particles";
  switch (stage) {
    case Stage::DivergenceSolve:
      return simulation.dfsph().divergence_solve() ? "" : "switched off";
    case Stage::Viscosity:
      return std::ranges::any_of(simulation.fluids(), isViscous) ? "" : "the viscosity is 0";
    case Stage::Gravity:
      return isZero(simulation.gravity()) ? "gravity is 0" : "";
    case Stage::Boundary:
      return traits.boundaryInReach ? "" : "no particle is near the container";
    default:
      return "";
  }
}

}  // namespace

std::string_view stageName(Stage stage) { return describe(stage).name; }

bool StepPlan::contains(Stage stage) const { return std::find(stages.begin(), stages.end(), stage) != stages.end(); }

StepPlan planStep(const v1::Simulation& simulation, const StepTraits& traits) {
  StepPlan plan;
  for (const StageDescription& description : descriptions()) {
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
