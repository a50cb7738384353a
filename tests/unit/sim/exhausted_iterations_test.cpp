// What becomes of steps whose density solve uses all its iterations up, short of its tolerance.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace sluice::sim {
namespace {

using testing::HasSubstr;

constexpr double kTolerance = 0.0005;

/// With so many iterations for every density solve.
v1::Simulation with(const std::string& solver, std::uint32_t iterations, v1::Simulation settings) {
  if (solver == "dfsph") {
    settings.mutable_dfsph()->set_max_iterations(iterations);
    settings.mutable_dfsph()->set_density_error(100 * kTolerance);
  } else {
    settings.mutable_iisph()->set_max_iterations(iterations);
    settings.mutable_iisph()->set_density_error(100 * kTolerance);
  }
  return settings;
}

/// Two cubes that meet head-on at 2 m/s each.
v1::Simulation collision() {
  v1::Simulation settings = floatingCube(10);
  v1::Block* left = settings.mutable_fluids(0)->mutable_blocks(0);
  v1::Block* right = settings.mutable_fluids(0)->add_blocks();
  *right = *left;
  left->mutable_first_particle()->set_x(-0.55);
  right->mutable_first_particle()->set_x(0.05);
  left->mutable_velocity()->set_x(2);
  right->mutable_velocity()->set_x(-2);
  return settings;
}

/// A cube at rest whose layers stand one percent too close.
v1::Simulation squeezedCube() {
  constexpr std::uint32_t kLayers = 10;
  v1::Simulation settings = floatingCube(kLayers);
  const v1::Block cube = settings.fluids(0).blocks(0);
  settings.mutable_fluids(0)->clear_blocks();
  for (std::uint32_t k = 0; k < kLayers; ++k) {
    v1::Block* layer = settings.mutable_fluids(0)->add_blocks();
    *layer = cube;
    layer->set_count_x(1);
    layer->mutable_first_particle()->set_x(0.99 * settings.particle_spacing() * k);
  }
  return settings;
}

struct Course {
  int steps = 0;
  int exhausted = 0;
  int recovering = 0;
  double worst = 0;  ///< Largest mean compression of any step.
};

Course courseOf(FluidSimulation& simulation, std::uint32_t iterations, double until) {
  Course course;
  while (simulation.time() < until && simulation.advance()) {
    const core::StepStatistics statistics = simulation.statistics();
    ++course.steps;
    course.exhausted += statistics.densityIterations == iterations ? 1 : 0;
    course.recovering += statistics.timeStepLimit == "recovery" ? 1 : 0;
    course.worst = std::max(course.worst, statistics.meanDensityError);
  }
  return course;
}

class ExhaustedIterations : public testing::TestWithParam<const char*> {};

// Taken as they are, these steps leave up to 0.9 % (DFSPH) and 1.1 % (IISPH).
TEST_P(ExhaustedIterations, ShortenStepsBeforeWhatTheyLeaveAddsUp) {
  FluidSimulation few(with(GetParam(), 2, collision()));
  const Course course = courseOf(few, 2, 0.3);
  EXPECT_EQ(few.halted(), "");
  EXPECT_GT(course.recovering, 0);
  EXPECT_LT(course.worst, 0.0065);
  // The steps after it are as long as ever.
  EXPECT_LT(course.steps, 75);
}

TEST_P(ExhaustedIterations, AStepThatAddsCompressionIsTakenBack) {
  v1::Simulation settings = with(GetParam(), 2, collision());
  settings.mutable_time_step()->set_min_seconds(0.004);
  FluidSimulation simulation(settings);
  const Course course = courseOf(simulation, 2, 0.3);
  EXPECT_THAT(simulation.halted(), HasSubstr("the density solve left a mean compression of 0."));
  EXPECT_THAT(simulation.halted(), HasSubstr("after 2 iterations, having found"));
  EXPECT_LT(course.worst, 4 * kTolerance);
}

TEST_P(ExhaustedIterations, AStepThatTakesSomeOfWhatWasThereIsTaken) {
  v1::Simulation settings = with(GetParam(), 2, squeezedCube());
  settings.mutable_time_step()->set_min_seconds(0.004);
  FluidSimulation simulation(settings);
  const double found = simulation.statistics().meanDensityError;
  ASSERT_GT(found, 5 * kTolerance);
  ASSERT_TRUE(simulation.advance()) << simulation.halted();
  EXPECT_EQ(simulation.statistics().densityIterations, 2U);
  EXPECT_GT(simulation.statistics().meanDensityError, 2 * kTolerance) << "short of the tolerance";
  EXPECT_LT(simulation.statistics().meanDensityError, found);
  courseOf(simulation, 2, 0.2);
  EXPECT_EQ(simulation.halted(), "");
}

// The last iteration may well reach the tolerance.
TEST_P(ExhaustedIterations, EnoughOfThemAreNoTrouble) {
  FluidSimulation simulation(with(GetParam(), 100, collision()));
  const Course course = courseOf(simulation, 100, 0.3);
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_EQ(course.exhausted, 0);
  EXPECT_EQ(course.recovering, 0);
}

INSTANTIATE_TEST_SUITE_P(Solvers, ExhaustedIterations, testing::Values("dfsph", "iisph"),
                         [](const auto& solver) { return std::string(solver.param); });

}  // namespace
}  // namespace sluice::sim
