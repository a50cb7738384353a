#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solvers/scenes.h"
#include "stability/body_cases.h"
#include "stability/particle_cases.h"
#include "stability/stability_map.h"
#include "stability/step_limits.h"
#include "stability/stiffness_cases.h"
#include "stability/tension_stability.h"

namespace sluice::evaluate {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(StabilityJobs, HaveNamesOfTheirOwn) {
  for (const bool quick : {true, false}) {
    std::set<std::string> names;
    for (const auto& jobs :
         {particleJobs(1), stiffnessJobs(quick, 1), bodyJobs(1), tensionJobs(1), limitJobs(1), mapJobs(quick, 1)}) {
      for (const StabilityJob& job : jobs) EXPECT_TRUE(names.insert(job.name).second) << job.name;
    }
    EXPECT_GT(names.size(), 100U);
  }
}

TEST(StabilityJobs, HonestIsWhatDoesNotBurstInSilence) {
  const auto of = [](Fate fate) {
    SolverOutcome outcome;
    outcome.fate = fate;
    return outcome;
  };
  for (const Fate fate : {Fate::Stable, Fate::Recovered, Fate::Stopped}) EXPECT_TRUE(isHonest(of(fate)));
  for (const Fate fate : {Fate::Bursts, Fate::NotFinite, Fate::Refused}) EXPECT_FALSE(isHonest(of(fate)));
  EXPECT_EQ(of(Fate::Recovered).word(), "recovered");
  EXPECT_EQ(of(Fate::Refused).word(), "stopped") << "before the first step, with a message";
}

Trial pairOfCubes() {
  Trial trial;
  trial.isExperiment = false;
  trial.steps = 2;
  trial.simulation.set_particle_spacing(0.1);
  v1::Vec3& corner = *trial.simulation.mutable_container()->mutable_max();
  corner.set_x(1);
  corner.set_y(1);
  corner.set_z(1);
  v1::Block& water = *trial.simulation.add_fluids()->add_blocks();
  water.mutable_first_particle()->set_x(0.1);
  water.mutable_first_particle()->set_y(0.1);
  water.mutable_first_particle()->set_z(0.1);
  v1::Body body;
  body.mutable_position()->set_x(0.5);
  body.mutable_position()->set_y(0.5);
  body.mutable_position()->set_z(0.5);
  body.mutable_box();
  body.mutable_floating()->mutable_velocity()->set_x(1);
  trial.bodies = {body};
  return trial;
}

TEST(SolverOutcomes, SeeBodiesThatLeaveTheContainer) {
  const Method method = defaultMethod(SolverKind::Dfsph);
  Trial trial = pairOfCubes();
  EXPECT_EQ(attempt(trial, method, 1).fate, Fate::Stable);
  trial.bodies[0].mutable_position()->set_x(3);
  EXPECT_EQ(attempt(trial, method, 1).fate, Fate::Bursts);
}

core::ParticleSnapshot lattice(float scale) {
  core::ParticleSnapshot particles;
  particles.spacing = 0.1;
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      particles.positions.emplace_back(scale * 0.1F * static_cast<float>(i), scale * 0.1F * static_cast<float>(j),
                                       0.0F);
      particles.densities.push_back(1000 / (scale * scale));
    }
  }
  return particles;
}

TEST(TensileState, TellsWhatComesApartFromWhatClumps) {
  const TensileState same = tensileState(lattice(1), 1000);
  EXPECT_NEAR(same.nearest, 1, 1e-5);
  EXPECT_NEAR(same.densityLost, 0, 1e-6);
  EXPECT_EQ(same.text(true), "");

  const TensileState apart = tensileState(lattice(2), 1000);
  EXPECT_NEAR(apart.densityLost, 0.75, 1e-6);
  EXPECT_THAT(apart.text(true), HasSubstr("75 % of the density lost: pressures below 0 are clamped"));
  EXPECT_THAT(apart.text(false), Not(HasSubstr("clamped")));

  const TensileState clumped = tensileState(lattice(0.5F), 4000);
  EXPECT_NEAR(clumped.nearest, 0.5, 1e-5);
  EXPECT_THAT(clumped.text(false), HasSubstr("tensile instability"));
}

TEST(StabilityMap, HasACellForEveryRowAndNamesWhatItShows) {
  std::vector<Row> rows;
  for (const double layers : {10.0, 40.0}) {
    for (const double step : {5e-4, 4e-3}) {
      rows.push_back({{"solver", std::string("dfsph")},
                      {"outcome", std::string(step > 1e-3 ? "stopped" : "stable")},
                      {"layers", layers},
                      {"step", step}});
    }
  }
  const std::string svg = drawStabilityMap(rows, "machine");
  std::size_t cells = 0;
  for (std::size_t at = svg.find("class=\"cell\""); at != std::string::npos; at = svg.find("class=\"cell\"", at + 1))
    ++cells;
  EXPECT_EQ(cells, rows.size() + 2) << "and two in the legend";
  EXPECT_THAT(svg, HasSubstr("40 layers, 4 ms: stopped"));
  EXPECT_THAT(svg, Not(HasSubstr("recovered by")));
}

}  // namespace
}  // namespace sluice::evaluate
