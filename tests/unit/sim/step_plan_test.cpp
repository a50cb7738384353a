#include "sluice/sim/step_plan.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

constexpr StepTraits kNearWall{.particles = 100, .boundaryInReach = true};

TEST(StepPlan, RunsEveryStageOfAFullScene) {
  const StepPlan plan = planStep(smallDamBreak(), kNearWall);
  EXPECT_THAT(plan.stages, ElementsAre(Stage::TimeStep, Stage::DivergenceSolve, Stage::Viscosity, Stage::Gravity,
                                       Stage::DensitySolve, Stage::Move, Stage::Sort, Stage::Neighbours,
                                       Stage::Boundary, Stage::Factors, Stage::DensityError));
  EXPECT_THAT(plan.leftOut, ElementsAre(core::LeftOut{"surface tension", "not asked for"},
                                        core::LeftOut{"adhesion", "no wall or body has any"},
                                        core::LeftOut{"micropolar", "not asked for"},
                                        core::LeftOut{"body friction", "no body has friction"},
                                        core::LeftOut{"touch", "nobody touches the fluid"},
                                        core::LeftOut{"rigid bodies", "none floats or is driven"},
                                        core::LeftOut{"drains", "none"}, core::LeftOut{"emitters", "none"},
                                        core::LeftOut{"moving boundary", "no body moves or has friction"}));
}

TEST(StepPlan, LeavesOutWhatASceneDoesNotNeed) {
  v1::Simulation still = floatingCube(4);
  still.mutable_dfsph()->set_divergence_solve(false);
  const StepPlan plan = planStep(still, {.particles = 64, .boundaryInReach = false});
  EXPECT_THAT(plan.stages, ElementsAre(Stage::TimeStep, Stage::DensitySolve, Stage::Move, Stage::Sort,
                                       Stage::Neighbours, Stage::Factors, Stage::DensityError));
  EXPECT_THAT(
      plan.leftOut,
      ElementsAre(core::LeftOut{"divergence solve", "switched off"}, core::LeftOut{"surface tension", "not asked for"},
                  core::LeftOut{"adhesion", "no wall or body has any"}, core::LeftOut{"micropolar", "not asked for"},
                  core::LeftOut{"viscosity", "the viscosity is 0"},
                  core::LeftOut{"body friction", "no body has friction"}, core::LeftOut{"gravity", "gravity is 0"},
                  core::LeftOut{"touch", "nobody touches the fluid"},
                  core::LeftOut{"rigid bodies", "none floats or is driven"}, core::LeftOut{"drains", "none"},
                  core::LeftOut{"emitters", "none"}, core::LeftOut{"boundary", "no particle is near a wall"},
                  core::LeftOut{"moving boundary", "no body moves or has friction"}));
}

TEST(StepPlan, RunsWhatBodiesNeedWhereTheyAreNear) {
  StepTraits traits = kNearWall;
  traits.bodiesMove = traits.bodiesRub = true;
  const StepPlan far = planStep(smallDamBreak(), traits);
  EXPECT_THAT(far.stages, Contains(Stage::RigidBodies));
  EXPECT_THAT(far.stages, Not(Contains(Stage::MovingBoundary)));
  EXPECT_THAT(far.stages, Not(Contains(Stage::BodyFriction)));
  traits.bodiesInReach = true;
  EXPECT_THAT(
      planStep(smallDamBreak(), traits).stages,
      ElementsAre(Stage::TimeStep, Stage::DivergenceSolve, Stage::Viscosity, Stage::BodyFriction, Stage::Gravity,
                  Stage::DensitySolve, Stage::RigidBodies, Stage::Move, Stage::Sort, Stage::Neighbours, Stage::Boundary,
                  Stage::MovingBoundary, Stage::Factors, Stage::DensityError));
}

TEST(StepPlan, DescribesEveryStageThatRuns) {
  const StepPlan plan = planStep(smallDamBreak(), kNearWall);
  const core::Plan described = describe(plan);
  ASSERT_EQ(described.stages.size(), plan.stages.size());
  for (std::size_t i = 0; i < plan.stages.size(); ++i) EXPECT_EQ(described.stages[i].name, stageName(plan.stages[i]));
}

std::vector<std::string> stagesTimed(const FluidSimulation& simulation) {
  std::vector<std::string> names;
  for (const core::StageTime& stage : simulation.statistics().stages) names.push_back(stage.name);
  return names;
}

TEST(StepPlan, IsWhatTheSimulationExecutes) {
  for (const bool calm : {false, true}) {
    v1::Simulation settings = calm ? floatingCube(5) : smallDamBreak();
    settings.mutable_dfsph()->set_divergence_solve(!calm);
    FluidSimulation simulation(settings);
    std::vector<std::string> planned;
    for (const core::PlannedStage& stage : simulation.plan().stages) planned.push_back(stage.name);
    ASSERT_TRUE(simulation.advance());
    EXPECT_EQ(stagesTimed(simulation), planned);
  }
}

TEST(StepPlan, BuffersAreCounted) {
  const FluidSimulation simulation(smallDamBreak());
  std::uint64_t bytes = 0;
  for (const core::PlannedBuffer& buffer : simulation.plan().buffers) bytes += buffer.bytes;
  EXPECT_GT(bytes, 100 * simulation.state().size());
}

/// Runs the scene with and without the stages that its plan leaves out as having no effect.
void expectInertStagesToBeInert(const v1::Simulation& settings, const char* leftOut) {
  FluidSimulation lean(settings, {.threads = 1});
  FluidSimulation full(settings, {.threads = 1, .keepInertStages = true});
  for (int step = 0; step < 15; ++step) {
    ASSERT_TRUE(lean.advance());
    ASSERT_TRUE(full.advance());
    EXPECT_THAT(stagesTimed(lean), testing::Not(Contains(leftOut)));
    EXPECT_THAT(stagesTimed(full), Contains(leftOut));
  }
  EXPECT_TRUE(lean.state() == full.state());
}

TEST(StepPlan, ViscosityStageAtZeroViscosityChangesNothing) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_fluids(0)->set_viscosity(0);
  expectInertStagesToBeInert(settings, "viscosity");
}

TEST(StepPlan, GravityStageWithoutGravityChangesNothing) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_gravity()->set_y(0);
  settings.mutable_fluids(0)->mutable_blocks(0)->mutable_velocity()->set_x(1);
  expectInertStagesToBeInert(settings, "gravity");
}

TEST(StepPlan, BoundaryStageFarFromTheContainerChangesNothing) {
  v1::Simulation settings = floatingCube(8);
  settings.mutable_gravity()->set_y(-9.81);
  expectInertStagesToBeInert(settings, "boundary");
}

/// Particles thrown about, each by itself; two of them meet after a while.
v1::Simulation thrownParticles() {
  v1::Simulation settings = floatingCube(1);
  settings.mutable_gravity()->set_y(-2);
  const v1::Block first = settings.fluids(0).blocks(0);
  for (int k = 1; k < 5; ++k) {
    v1::Block block = first;
    block.mutable_first_particle()->set_x(0.4 * k);
    block.mutable_velocity()->set_x(k == 1 ? -2 : 0.5 * k);
    *settings.mutable_fluids(0)->add_blocks() = block;
  }
  return settings;
}

TEST(StepPlan, ParticlesInFreeFlightSearchForNoNeighbours) {
  const v1::Simulation settings = thrownParticles();
  FluidSimulation lean(settings, {.threads = 1});
  FluidSimulation full(settings, {.threads = 1, .keepInertStages = true});
  int searches = 0;
  bool met = false;
  while (lean.time() < 0.4) {
    ASSERT_TRUE(lean.advance());
    ASSERT_TRUE(full.advance());
    searches += std::ranges::count(stagesTimed(lean), "neighbours") > 0 ? 1 : 0;
    met = met || std::ranges::any_of(full.neighbours().neighbours(), [](int count) { return count > 0; });
    ASSERT_TRUE(lean.state() == full.state()) << "at " << lean.time() << " s";
  }
  EXPECT_TRUE(met);
  EXPECT_GT(searches, 0);
  EXPECT_LT(searches, static_cast<int>(lean.statistics().steps) / 2);
}

TEST(StepPlan, NamesFreeFlightAsTheReason) {
  v1::Simulation settings = floatingCube(1);
  settings.mutable_gravity()->set_y(-1);
  const StepPlan plan = planStep(settings, {.particles = 1, .boundaryInReach = false, .freeFlight = true});
  EXPECT_THAT(plan.stages, ElementsAre(Stage::TimeStep, Stage::Gravity, Stage::Move, Stage::Sort, Stage::DensityError));
  EXPECT_THAT(plan.leftOut, Contains(core::LeftOut{"neighbours", "no particle can meet another in this step"}));
}

TEST(StepPlan, HoldsTheStagesOfTheMethodsChosenAlone) {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_wcsph();
  const auto has = [&](Stage stage) { return planStep(settings, kNearWall).contains(stage); };
  EXPECT_TRUE(has(Stage::EquationOfState));
  EXPECT_FALSE(has(Stage::DensitySolve) || has(Stage::DivergenceSolve) || has(Stage::Factors));
  settings.mutable_pbf();
  EXPECT_TRUE(has(Stage::PositionSolve));
  EXPECT_FALSE(has(Stage::EquationOfState) || has(Stage::DensitySolve));
  settings.mutable_iisph();
  EXPECT_TRUE(has(Stage::DensitySolve) && has(Stage::Factors));
  EXPECT_FALSE(has(Stage::DivergenceSolve));
}

}  // namespace
}  // namespace sluice::sim
