#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "support.h"

namespace sluice::scene::test {
namespace {

using testing::HasSubstr;

template <class Change>
core::InputError errorAfter(Change&& change) {
  v1::Scene scene = smallScene();
  change(scene);
  return inputError([&] { validate(scene); });
}

TEST(Validate, AcceptsTheEndsOfARange) {
  v1::Scene scene = smallScene();
  v1::Fluid& fluid = *scene.mutable_simulation()->mutable_fluids(0);
  for (const double viscosity : {0.0, 100.0}) {
    fluid.set_viscosity(viscosity);
    EXPECT_NO_THROW(validate(scene));
  }
}

TEST(Validate, RefusesWhatLiesJustOutside) {
  const auto error = errorAfter(
      [](v1::Scene& s) { s.mutable_simulation()->mutable_fluids(0)->set_viscosity(std::nextafter(100.0, 101.0)); });
  EXPECT_EQ(error.fieldPath(), "simulation.fluids[0].viscosity");
}

TEST(Validate, RefusesWhatIsNotFinite) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto error = errorAfter([&](v1::Scene& s) { s.mutable_playback()->set_speed(value); });
    EXPECT_EQ(error.fieldPath(), "playback.speed");
    EXPECT_THAT(error.problem(), HasSubstr("not a finite number"));
  }
}

TEST(Validate, RefusesEachComponentOfAVector) {
  const auto error = errorAfter([](v1::Scene& s) { s.mutable_look()->mutable_liquid()->mutable_colour()->set_z(1.5); });
  EXPECT_STREQ(error.what(), "look.liquid.colour.z: 1.5 is outside [0, 1]");
}

TEST(Validate, RefusesVectorsOfLengthZeroWhereADirectionIsMeant) {
  const auto error = errorAfter([](v1::Scene& s) { s.mutable_camera()->mutable_up()->set_y(0); });
  EXPECT_STREQ(error.what(), "camera.up: must not be of length 0");
}

TEST(Validate, TakesOnlyTheValuesOfAList) {
  const auto error = errorAfter([](v1::Scene& s) { s.mutable_look()->mutable_thickness()->set_divisor(3); });
  EXPECT_STREQ(error.what(), "look.thickness.divisor: 3 is not allowed; allowed is 1, 2 or 4");
}

TEST(Validate, TakesOnlyTheWordsOfAList) {
  const auto error = errorAfter([](v1::Scene& s) { s.mutable_look()->set_preset("hony"); });
  EXPECT_EQ(error.fieldPath(), "look.preset");
  EXPECT_THAT(error.problem(), HasSubstr("did you mean honey?"));
}

TEST(Validate, ComparesNeighbouringFields) {
  auto error = errorAfter([](v1::Scene& s) { s.mutable_simulation()->mutable_container()->mutable_max()->set_y(-1); });
  EXPECT_STREQ(error.what(),
               "simulation.container.min: (-1, -1, -1) must be below max, (1, -1, 1), in every component");
  error = errorAfter([](v1::Scene& s) { s.mutable_simulation()->mutable_time_step()->set_min_seconds(0.006); });
  EXPECT_STREQ(error.what(), "simulation.time_step.min_seconds: 0.006 must be at most max_seconds, 0.005");
}

TEST(Validate, CountsTheElementsOfLists) {
  auto error = errorAfter([](v1::Scene& s) { s.mutable_simulation()->clear_fluids(); });
  EXPECT_STREQ(error.what(), "simulation.fluids: has 0 elements; needs at least 1");
  error = errorAfter([](v1::Scene& s) {
    const v1::Fluid fluid = s.simulation().fluids(0);
    while (s.simulation().fluids_size() < 9) *s.mutable_simulation()->add_fluids() = fluid;
  });
  EXPECT_STREQ(error.what(), "simulation.fluids: has 9 elements; allowed are at most 8");
}

TEST(Validate, AsksForWhatIsRequired) {
  auto error = errorAfter([](v1::Scene& s) { s.mutable_simulation()->mutable_container()->clear_min(); });
  EXPECT_EQ(error.fieldPath(), "simulation.container.min");
  error = errorAfter([](v1::Scene& s) { s.mutable_particle_file(); });
  EXPECT_EQ(error.fieldPath(), "particle_file.path");
  error = errorAfter([](v1::Scene& s) { s.mutable_particle_file()->set_path(""); });
  EXPECT_STREQ(error.what(), "particle_file.path: must not be empty");
}

TEST(Validate, PutsThePrefixBeforeThePath) {
  v1::Camera camera;
  camera.set_vertical_fov_degrees(180);
  const auto error = inputError([&] { validate(camera, "set_camera.camera"); });
  EXPECT_STREQ(error.what(), "set_camera.camera.vertical_fov_degrees: 180 is outside [1, 150] °");
}

}  // namespace
}  // namespace sluice::scene::test
