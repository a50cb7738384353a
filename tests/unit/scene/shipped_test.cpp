#include <gmock/gmock.h>

#include "sluice/scene/convert.h"
#include "support.h"

namespace sluice::scene::test {
namespace {

using testing::HasSubstr;

std::uint64_t latticeParticles(const v1::Scene& scene) {
  std::uint64_t count = 0;
  for (const v1::Fluid& fluid : scene.simulation().fluids()) {
    for (const v1::Block& block : fluid.blocks()) {
      count += std::uint64_t{block.count_x()} * block.count_y() * block.count_z();
    }
  }
  return count;
}

TEST(Shipped, AllAreValidAndHaveATitle) {
  ASSERT_GE(shippedScenes().size(), 3U);
  for (const ShippedScene& shipped : shippedScenes()) {
    EXPECT_TRUE(isShipped(shipped.name));
    EXPECT_FALSE(shipped.title.empty()) << shipped.name;
    EXPECT_FALSE(shipped.description.empty()) << shipped.name;
    EXPECT_NO_THROW(validate(loadShipped(shipped.name)));
  }
}

TEST(Shipped, RefusesOtherNamesAndListsItsOwn) {
  EXPECT_FALSE(isShipped("dam_brake"));
  EXPECT_STREQ(inputError([] { loadShipped("dam_brake"); }).what(),
               "no shipped scene is called \"dam_brake\"; did you mean dam_break?");
  EXPECT_THAT(inputError([] { loadShipped("x"); }).what(), HasSubstr("column_and_sheet, corridor_flood, cube, dam_break"));
}

TEST(Shipped, DamBreakHasTwelveThousandParticles) { EXPECT_EQ(latticeParticles(loadShipped("dam_break")), 12000U); }

// The lattices lie inside their container with room for the boundary: one spacing from each wall.
TEST(Shipped, LatticesStayOneSpacingFromTheWalls) {
  for (const char* name : {"dam_break", "double_dam_break"}) {
    const v1::Scene scene = loadShipped(name);
    const v1::Simulation& simulation = scene.simulation();
    const double spacing = simulation.particle_spacing();
    const Eigen::Array3d low = toVector(simulation.container().min()).array() + spacing - 1e-9;
    const Eigen::Array3d high = toVector(simulation.container().max()).array() - spacing + 1e-9;
    for (const v1::Block& block : simulation.fluids(0).blocks()) {
      const Eigen::Array3d first = toVector(block.first_particle());
      const Eigen::Array3d steps(block.count_x() - 1.0, block.count_y() - 1.0, block.count_z() - 1.0);
      EXPECT_TRUE((first >= low).all()) << name;
      EXPECT_TRUE((first + spacing * steps <= high).all()) << name;
    }
  }
}

// Published timings use this scene: its figures must not drift.
TEST(Shipped, DoubleDamBreakIsTheMeasuredScene) {
  const v1::Scene scene = loadShipped("double_dam_break");
  const v1::Simulation& simulation = scene.simulation();
  EXPECT_EQ(latticeParticles(scene), 29952U);
  EXPECT_EQ(simulation.particle_spacing(), 0.05);
  EXPECT_EQ(toVector(simulation.container().min()), Eigen::Vector3d(-1.55, -0.05, -1.55));
  EXPECT_EQ(toVector(simulation.container().max()), Eigen::Vector3d(1.55, 3.05, 1.55));
  EXPECT_EQ(toVector(simulation.fluids(0).blocks(0).first_particle()), Eigen::Vector3d(-1.45, 0.05, -1.45));
  EXPECT_EQ(toVector(simulation.fluids(0).blocks(1).first_particle()), Eigen::Vector3d(0.30, 0.05, 0.30));
  EXPECT_EQ(simulation.fluids(0).rest_density(), 1000);
  EXPECT_EQ(simulation.fluids(0).viscosity(), 0.01);
  EXPECT_EQ(toVector(simulation.gravity()), Eigen::Vector3d(0, -9.81, 0));
  EXPECT_EQ(simulation.dfsph().density_error(), 0.05);
  EXPECT_EQ(simulation.dfsph().divergence_error(), 0.1);
  EXPECT_EQ(simulation.time_step().cfl(), 0.4);
  EXPECT_EQ(simulation.time_step().max_seconds(), 0.005);
}

TEST(Shipped, ColumnAndSheetIsTheMeasuredScene) {
  const v1::Scene scene = loadShipped("column_and_sheet");
  EXPECT_EQ(scene.column_and_sheet().particles(), 64000U);
  EXPECT_EQ(scene.look().splats().radius_in_spacings(), 0.9);
  EXPECT_EQ(toVector(scene.camera().eye()), Eigen::Vector3d(1.9, 1.25, 3.0));
  EXPECT_EQ(toVector(scene.camera().target()), Eigen::Vector3d(0.85, 0.25, 0.5));
  EXPECT_EQ(toVector(scene.camera().up()), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(scene.camera().vertical_fov_degrees(), 45);
}

TEST(Convert, CamerasSurviveTheRoundTrip) {
  const core::Camera camera{{1, 2, 3}, {4, 5, 6}, {0, 0, 1}, 30};
  EXPECT_EQ(toCamera(fromCamera(camera)), camera);
}

}  // namespace
}  // namespace sluice::scene::test
