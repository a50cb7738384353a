#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "progress.h"
#include "solvers/measures.h"
#include "solvers/page.h"
#include "solvers/run_store.h"
#include "solvers/solvers_study.h"
#include "stability/solver_outcome.h"
#include "stability/step_limits.h"

namespace sluice::evaluate {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Oscillation, FindsThePeriodBetweenSamples) {
  Oscillation signal;
  for (int i = 0; i <= 400; ++i) signal.add(0.013 * i, std::cos(2 * M_PI * 0.013 * i / 1.3) + 0.2);
  EXPECT_NEAR(signal.period(0.2), 1.3, 1e-4);
  EXPECT_NEAR(signal.highest(), 1.2, 1e-3);
  EXPECT_NEAR(signal.lowest(), -0.8, 1e-3);
}

TEST(Oscillation, HasNoPeriodWhereItDoesNotSwing) {
  Oscillation signal;
  for (int i = 0; i < 10; ++i) signal.add(i, i - 4.5);
  EXPECT_TRUE(std::isnan(signal.period()));
}

TEST(PlaneMoments, OfARotatingPair) {
  core::ParticleSnapshot pair;
  pair.positions = {{3, 1, 0}, {1, 1, 0}};
  pair.velocities = {{0, 2, 0}, {0, -2, 0}};
  const PlaneMoments moments = planeMoments(pair);
  EXPECT_DOUBLE_EQ(moments.xx, 1);
  EXPECT_DOUBLE_EQ(moments.yy, 0);
  EXPECT_DOUBLE_EQ(moments.spin, 2);
  EXPECT_DOUBLE_EQ(moments.kinetic, 2);
  EXPECT_EQ(moments.momentum, Eigen::Vector3d(0, 0, 0));
}

TEST(Interpolated, KeepsConstantsAndEvensOutAlternation) {
  core::ParticleSnapshot lattice;
  lattice.spacing = 0.1;
  std::vector<double> values;
  for (int j = 0; j < 12; ++j) {
    for (int i = 0; i < 12; ++i) {
      lattice.positions.emplace_back(0.1F * static_cast<float>(i), 0.1F * static_cast<float>(j), 0.0F);
      values.push_back(5 + ((i + j) % 2 == 0 ? 1 : -1));
    }
  }
  for (const double value : interpolated(lattice, std::vector<double>(values.size(), 7))) EXPECT_NEAR(value, 7, 1e-12);
  const std::vector<double> field = interpolated(lattice, values);
  EXPECT_LT(std::abs(field[5 * 12 + 5] - 5), 0.3);
}

class RunStoreTest : public testing::Test {
 protected:
  RunStoreTest() : file_(std::filesystem::temp_directory_path() / ("sluice_runs_" + std::to_string(getpid()))) {}
  ~RunStoreTest() override { std::filesystem::remove(file_); }

  std::filesystem::path file_;
};

TEST_F(RunStoreTest, GoesOnWithWhatIsDone) {
  const Row row{{"case", std::string("a")},
                {"error", 0.25},
                {"steps", std::int64_t{3}},
                {"passed", true},
                {"tolerance", std::nan("")}};
  {
    RunStore store(file_, false);
    store.add("first", {row});
  }
  std::ofstream(file_, std::ios::app) << "{\"run\":\"second\",\"rows\":[{\"ca";  // cut off
  const RunStore resumed(file_, true);
  ASSERT_NE(resumed.find("first"), nullptr);
  EXPECT_EQ(resumed.find("second"), nullptr);
  const Row& back = resumed.find("first")->front();
  EXPECT_EQ(back.text("case"), "a");
  EXPECT_EQ(back.number("error"), 0.25);
  EXPECT_EQ(back.number("steps"), 3);
  EXPECT_TRUE(back.flag("passed"));
  EXPECT_TRUE(std::isnan(back.number("tolerance")));
}

TEST_F(RunStoreTest, BeginsAnewUnlessAskedToGoOn) {
  RunStore(file_, false).add("first", {});
  EXPECT_EQ(RunStore(file_, false).find("first"), nullptr);
}

TEST(ProgressBar, FillsUp) {
  EXPECT_EQ(progressBar(0, 4), "[--------------------]");
  EXPECT_EQ(progressBar(1, 4), "[#####---------------]");
  EXPECT_EQ(progressBar(4, 4), "[####################]");
}

TEST(Progress, TakesWhatIsLeftFromWhatItRan) {
  std::vector<std::string> told;
  Options options;
  options.progress = [&](const std::string& text) { told.push_back(text); };
  Progress progress(options, 4);
  progress.begin("a", true);
  progress.begin("b");
  progress.begin("c");
  ASSERT_EQ(told.size(), 3U);
  EXPECT_THAT(told[1], Not(HasSubstr("left"))) << "a part that was kept says nothing about the others";
  EXPECT_THAT(told[2], HasSubstr("[##########----------] 2 of 4, 0 s left: c"));
}

Row errorRow(double spacing, double error) {
  return {{"case", std::string("c")},
          {"solver", std::string("s")},
          {"setting", std::string("s 1")},
          {"tolerance", std::nan("")},
          {"error_norm", std::string("e")},
          {"spacing", spacing},
          {"error", error},
          {"wall_seconds", 1 / spacing},
          {"reference", std::string("r")}};
}

TEST(ConvergenceOrders, AreSlopesFromTheCoarsestToTheFinest) {
  const std::vector<Row> orders =
      convergenceOrders({errorRow(0.1, 0.08), errorRow(0.05, 0.021), errorRow(0.025, 0.005)});
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_NEAR(orders[0].number("order"), 2, 1e-12);
  EXPECT_TRUE(convergenceOrders({errorRow(0.1, 0.08), errorRow(0.05, std::nan(""))}).empty());
}

TEST(SolverPlot, NamesItsFileByTheCase) {
  EXPECT_EQ(solverPlotName("hydrostatic column, cold starts"), "solvers_hydrostatic_column_cold_starts.svg");
  EXPECT_THAT(solverPlot({errorRow(0.1, 0.08), errorRow(0.05, 0.02)}, "c", "e", "machine"), HasSubstr("<svg"));
}

TEST(StepLimits, TheLatticesFastestWaveIsFasterThanSoundAndNotByMuch) {
  // A continuum would allow 2/(π c0/d); kernels filter the shortest waves.
  EXPECT_GT(latticeAcousticLimit(), 2 / M_PI);
  EXPECT_LT(latticeAcousticLimit(), 4);
}

TEST(SolverOutcomes, AreToldApart) {
  Trial trial;
  trial.simulation.set_planar(true);
  trial.simulation.set_particle_spacing(0.05);
  trial.simulation.mutable_gravity()->set_y(0);
  trial.simulation.mutable_container()->mutable_min()->set_z(-0.1);
  v1::Vec3* max = trial.simulation.mutable_container()->mutable_max();
  max->set_x(1);
  max->set_y(1);
  max->set_z(0.1);
  trial.simulation.add_fluids();
  trial.experiment.positions = {{0.5, 0.5, 0}};
  trial.steps = 3;
  const Method method = defaultMethod(SolverKind::Dfsph);
  EXPECT_EQ(attempt(trial, method, 1).fate, Fate::Stable);

  trial.experiment.velocities = {{1, 0, 0}};
  trial.speedLimit = 0.5;
  EXPECT_EQ(attempt(trial, method, 1).fate, Fate::Bursts);

  trial.experiment.velocities = {{1e6, 0, 0}};
  EXPECT_EQ(attempt(trial, method, 1).fate, Fate::Stopped);
  EXPECT_THAT(attempt(trial, method, 1).text(), HasSubstr("min_seconds"));

  trial.experiment.positions = {{2, 0.5, 0}};
  EXPECT_EQ(attempt(trial, method, 1).fate, Fate::Refused);
}

}  // namespace
}  // namespace sluice::evaluate
