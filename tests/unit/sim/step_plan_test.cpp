#include "sluice/sim/step_plan.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr StepTraits kNearWall{.particles = 100, .boundaryInReach = true};

TEST(StepPlan, RunsEveryStageOfAFullScene) {
  const StepPlan plan = planStep(smallDamBreak(), kNearWall);
  EXPECT_THAT(plan.stages, ElementsAre(Stage::TimeStep, Stage::DivergenceSolve, Stage::Viscosity, Stage::Gravity,
                                       Stage::DensitySolve, Stage::Move, Stage::Sort, Stage::Neighbours,
                                       Stage::Boundary, Stage::Factors));
  EXPECT_THAT(plan.leftOut, IsEmpty());
}

TEST(StepPlan, LeavesOutWhatASceneDoesNotNeed) {
  v1::Simulation still = floatingCube(4);
  still.mutable_dfsph()->set_divergence_solve(false);
  const StepPlan plan = planStep(still, {.particles = 64, .boundaryInReach = false});
  EXPECT_THAT(plan.stages, ElementsAre(Stage::TimeStep, Stage::DensitySolve, Stage::Move, Stage::Sort,
                                       Stage::Neighbours, Stage::Factors));
  EXPECT_THAT(plan.leftOut,
              ElementsAre(core::LeftOut{"divergence solve", "switched off"},
                          core::LeftOut{"viscosity", "the viscosity is 0"}, core::LeftOut{"gravity", "gravity is 0"},
                          core::LeftOut{"boundary", "no particle is near the container"}));
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

}  // namespace
}  // namespace sluice::sim
