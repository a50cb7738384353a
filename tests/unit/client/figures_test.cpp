// What the client works out by itself: percentiles, delays, the orbit, and how figures are written.

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "print_json.h"
#include "sluice/client/delay_meter.h"
#include "sluice/client/json.h"
#include "sluice/client/percentile.h"
#include "sluice/client/report.h"
#include "sluice/client/stream_benchmark.h"

namespace sluice::client {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

TEST(Percentile, InterpolatesBetweenNeighbours) {
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(percentile({10, 20, 30}, 0), 10);
  EXPECT_DOUBLE_EQ(percentile({10, 20, 30}, 1), 30);
  EXPECT_DOUBLE_EQ(percentile({0, 100}, 0.95), 95);
  EXPECT_DOUBLE_EQ(median({7}), 7);
}

TEST(Percentile, OfNothingIsNotANumber) { EXPECT_TRUE(std::isnan(percentile({}, 0.5))); }

TEST(DelayMeter, CountsEachInputOnceWhenItFirstShows) {
  DelayMeter meter;
  const DelayMeter::Clock::time_point start{};
  meter.sent(3, start);
  meter.sent(5, start + 10ms);
  meter.sent(6, start + 20ms);
  meter.decoded(2, start + 25ms);
  EXPECT_TRUE(meter.milliseconds().empty());
  // The server skipped 3 in favour of 5; this frame is the first to show either.
  meter.decoded(5, start + 30ms);
  EXPECT_THAT(meter.milliseconds(), ElementsAre(30, 20));
  EXPECT_TRUE(meter.waiting());
  meter.decoded(6, start + 60ms);
  meter.decoded(6, start + 70ms);
  EXPECT_THAT(meter.milliseconds(), ElementsAre(30, 20, 40));
  EXPECT_FALSE(meter.waiting());
}

v1::Camera camera() {
  v1::Camera result;
  result.mutable_eye()->set_x(3);
  result.mutable_eye()->set_y(2);
  result.mutable_target()->set_y(1);
  result.mutable_up()->set_y(2);  // of any length
  return result;
}

TEST(Orbit, TurnsAboutTheUpDirectionThroughTheTarget) {
  const v1::Camera quarter = orbited(camera(), std::numbers::pi / 2);
  EXPECT_NEAR(quarter.eye().x(), 0, 1e-12);
  EXPECT_NEAR(quarter.eye().y(), 2, 1e-12);
  EXPECT_NEAR(quarter.eye().z(), -3, 1e-12);
  EXPECT_EQ(quarter.target().y(), 1);
}

TEST(Orbit, ComesBackAfterAWholeTurn) {
  const v1::Camera turned = orbited(camera(), 2 * std::numbers::pi);
  EXPECT_NEAR(turned.eye().x(), 3, 1e-12);
  EXPECT_NEAR(turned.eye().z(), 0, 1e-12);
}

TEST(Json, IsOneLineInTheOrderOfItsMembers) {
  EXPECT_EQ(toLine({{"b", 1.5}, {"a", "line\nbreak"}, {"nothing", std::nan("")}}),
            "{\"b\":1.5,\"a\":\"line\\nbreak\",\"nothing\":null}\n");
}

v1::Stats stats() {
  v1::Stats result;
  result.set_simulation_time(1.25);
  result.set_steps(500);
  result.set_particles(12000);
  result.set_time_step_seconds(0.0025);
  result.set_time_step_limit("cfl");
  result.set_density_iterations(4);
  result.set_mean_density_error(0.0005);
  v1::StageTime& stage = *result.add_stages();
  stage.set_name("density solve");
  stage.set_milliseconds(3.5);
  return result;
}

TEST(Report, JsonHasEveryFieldOfStats) {
  const Json json = statsJson(stats());
  const auto* type = v1::Stats::descriptor();
  for (int i = 0; i < type->field_count(); ++i)
    EXPECT_TRUE(json.contains(type->field(i)->name())) << type->field(i)->name();
  EXPECT_EQ(json["stages"]["density solve"], 3.5);
}

TEST(Report, TableSaysWhatTheSimulationDoes) {
  const std::string table = statsTable(stats());
  for (const char* part : {"playing", "1.250 s after 500 steps", "12000", "2.500 ms, set by cfl", "4 density",
                           "0.050 % mean", "density solve", "3.50"}) {
    EXPECT_THAT(table, HasSubstr(part));
  }
}

TEST(Report, LinesStandUnderTheirHeading) {
  const std::string heading = statsLineHeading();
  const std::string line = statsLine(stats());
  EXPECT_EQ(line.find("500"), heading.find("steps"));
  EXPECT_EQ(line.find("2.500"), heading.find("dt_ms"));
  EXPECT_EQ(line.find("playing"), heading.find("state"));
}

TEST(Report, AHaltIsTold) {
  v1::Stats halted = stats();
  halted.set_halted("time step below 1e-06 s");
  EXPECT_EQ(stateText(halted), "halted: time step below 1e-06 s");
}

}  // namespace
}  // namespace sluice::client
