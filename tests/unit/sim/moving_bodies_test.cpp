// Bodies that float and that are driven: coupled with the fluid both ways.

#include "moving_bodies.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"
#include "sluice/core/state_stream.h"
#include "sluice/solids/mass_properties.h"

namespace sluice::sim {
namespace {

using Eigen::Vector3d;

v1::Body floatingBox(const Vector3d& middle, const Vector3d& size, double density) {
  v1::Body body = box(middle, size);
  body.mutable_floating()->set_density(density);
  return body;
}

/// A pool `width` particles square, `layers` deep and as much air above.
v1::Simulation pool(std::uint32_t width, std::uint32_t layers) {
  v1::Simulation settings = column(width, layers);
  settings.mutable_fluids(0)->set_viscosity(0.05);
  return settings;
}

Vector3d momentumOfFluid(const FluidSimulation& simulation) {
  const double mass = 1000 * kSpacing * kSpacing * kSpacing;
  Vector3d sum = Vector3d::Zero();
  for (const Float4& v : simulation.state().velocity) sum += mass * Vector3d(v.x, v.y, v.z);
  return sum;
}

/// Height of the surface of a pool's own water over its floor, from the water's middle, m. Beside walls that answer as
/// they do where a body moves, here one in the air, it settles a little below its lattice.
double settledDepth(const v1::Simulation& settings) {
  v1::Body lid = box({0.5, 1.4, 0.5}, {0.1, 0.1, 0.1});
  lid.mutable_driven()->mutable_sway()->set_x(0.01);
  lid.mutable_driven()->set_period_seconds(1);
  FluidSimulation simulation(settings, listOf({lid}));
  runUntil(simulation, 2);
  double sum = 0;
  for (const Float4& x : simulation.state().position) sum += x.y;
  return 2 * (sum / static_cast<double>(simulation.state().size()) - 0.5 * kSpacing);
}

// By what it weighs and by how much the water rises, within 4 % of the box's height: a fourth of a spacing.
TEST(MovingBodies, ABoxFloatsAtArchimedesDraught) {
  constexpr int kWidth = 19;
  constexpr int kLayers = 10;
  const Vector3d size(0.4, 0.3, 0.4);
  v1::Simulation settings = pool(kWidth, kLayers);
  settings.mutable_container()->mutable_max()->set_y(1.5);
  const double depth = settledDepth(settings);
  EXPECT_NEAR(depth, kSpacing * kLayers, 0.5 * kSpacing);
  for (const double density : {400.0, 700.0}) {
    const double mass = density * size.prod();
    const double draught = mass / (1000 * size.x() * size.z());
    // Walls are half a spacing from the fluid's volume.
    const double side = kSpacing * kWidth;
    const double level = 0.5 * kSpacing + depth + mass / 1000 / (side * side);
    FluidSimulation simulation(settings, listOf({floatingBox({0.5, 0.75, 0.5}, size, density)}));
    runUntil(simulation, 4);
    ASSERT_EQ(simulation.halted(), "");
    double height = 0;
    int count = 0;
    while (simulation.time() < 5 && simulation.advance()) {
      height += simulation.movingBodies().centre(0).y();
      ++count;
    }
    height /= count;
    const double expected = level - draught + 0.5 * size.y();
    EXPECT_NEAR(height, expected, 0.04 * size.y()) << density;
    EXPECT_LT(simulation.movingBodies().twist(0).head<3>().norm(), 0.1);
  }
}

// A cube of water flies into a box, without gravity and walls.
TEST(MovingBodies, ExchangeMomentumExactly) {
  for (const double density : {50.0, 1000.0, 20000.0}) {
    v1::Simulation settings = floatingCube(8);
    v1::Block* block = settings.mutable_fluids(0)->mutable_blocks(0);
    block->mutable_velocity()->set_x(1.5);
    FluidSimulation simulation(settings, listOf({floatingBox({0.6, 0.1, 0}, {0.3, 0.3, 0.3}, density)}));
    const double mass = density * 0.027;
    const Vector3d before = momentumOfFluid(simulation);
    for (int step = 0; step < 120; ++step) ASSERT_TRUE(simulation.advance()) << simulation.halted();
    const Vector3d ofBox = mass * simulation.movingBodies().twist(0).head<3>();
    EXPECT_GT(ofBox.x(), 0.02 * before.x()) << "they have met";
    EXPECT_LT((momentumOfFluid(simulation) + ofBox - before).norm(), 2e-3 * before.norm()) << density;
  }
}

// The same water, and bodies a thousand times lighter and heavier than it.
TEST(MovingBodies, AnyMassIsStable) {
  for (const double density : {1.0, 1e6}) {
    FluidSimulation simulation(pool(10, 8), listOf({floatingBox({0.27, 0.62, 0.27}, {0.2, 0.2, 0.2}, density)}));
    runUntil(simulation, 0.6);
    EXPECT_EQ(simulation.halted(), "") << density;
    const Vector3d centre = simulation.movingBodies().centre(0);
    EXPECT_TRUE(centre.allFinite());
    EXPECT_GT(centre.y(), 0.08);
    EXPECT_LT(centre.y(), 0.8);
    EXPECT_LT(simulation.statistics().maxSpeed, 10);
    if (density > 1000) {
      EXPECT_NEAR(centre.y(), 0.1, 0.02) << "it lies on the floor";
    }
  }
}

TEST(MovingBodies, APaddleMakesAWaveAndLeaksNothing) {
  v1::Simulation settings = pool(10, 8);
  settings.mutable_container()->mutable_max()->set_x(2.05);
  settings.mutable_fluids(0)->mutable_blocks(0)->set_count_x(30);
  settings.mutable_fluids(0)->mutable_blocks(0)->mutable_first_particle()->set_x(0.5);
  v1::Body paddle = box({0.4, 0.4, 0.275}, {0.1, 0.8, 0.55});
  paddle.mutable_driven()->mutable_sway()->set_x(0.2);
  paddle.mutable_driven()->set_period_seconds(1);
  FluidSimulation simulation(settings, listOf({paddle}));
  const std::size_t particles = simulation.state().size();
  double highest = 0;
  double leftmost = 1;
  double rightmost = 0;
  while (simulation.time() < 2 && simulation.advance()) {
    const double face = simulation.movingBodies().centre(0).x() + 0.05;
    leftmost = std::min(leftmost, face);
    rightmost = std::max(rightmost, face);
    for (const Float4& x : simulation.state().position) {
      // Under its upper edge, nothing comes to its far side.
      if (x.y < 0.75F) {
        ASSERT_GT(static_cast<double>(x.x), face - 0.001) << "at " << simulation.time();
      }
      highest = std::max(highest, static_cast<double>(x.y));
    }
  }
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_EQ(simulation.state().size(), particles);
  EXPECT_NEAR(rightmost - leftmost, 0.4, 0.02);
  EXPECT_GT(highest, 0.5) << "0.4 m of water";
}

TEST(MovingBodies, ATurningTankTakesViscousWaterAlong) {
  v1::Simulation settings = pool(9, 6);
  set(settings.mutable_container()->mutable_min(), {-0.5, 0, -0.5});
  set(settings.mutable_container()->mutable_max(), {0.5, 1, 0.5});
  set(settings.mutable_fluids(0)->mutable_blocks(0)->mutable_first_particle(), {-0.2, 0.15, -0.2});
  settings.mutable_fluids(0)->set_viscosity(0.1);
  v1::Body tank;
  set(tank.mutable_position(), {0, 0.5, 0});
  tank.mutable_cylinder()->set_radius(0.35);
  tank.mutable_cylinder()->set_height(0.8);
  tank.mutable_cylinder()->set_open_top(true);
  tank.mutable_glass();
  tank.set_friction(0.1);
  constexpr double kSpin = 3;  // rad/s
  tank.mutable_driven()->mutable_spin()->set_y(kSpin * 180 / std::numbers::pi);
  FluidSimulation simulation(settings, listOf({tank}));
  runUntil(simulation, 4);
  ASSERT_EQ(simulation.halted(), "");
  const auto snapshot = simulation.snapshot();
  double angular = 0;
  double inertia = 0;
  for (std::size_t i = 0; i < snapshot->size(); ++i) {
    const Eigen::Vector3f& x = snapshot->positions[i];
    const Eigen::Vector3f& v = snapshot->velocities[i];
    EXPECT_LT(std::hypot(x.x(), x.z()), 0.35F);
    angular += static_cast<double>(x.z() * v.x() - x.x() * v.z());
    inertia += static_cast<double>(x.x() * x.x() + x.z() * x.z());
  }
  EXPECT_NEAR(angular / inertia, kSpin, 0.1 * kSpin) << "as a solid body";
}

TEST(MovingBodies, FrictionKeepsMomentumToo) {
  v1::Simulation settings = floatingCube(8);
  v1::Body plate = floatingBox({0, -0.28, 0}, {0.6, 0.11, 0.6}, 500);
  plate.set_friction(1);
  settings.mutable_fluids(0)->mutable_blocks(0)->mutable_velocity()->set_x(1);
  FluidSimulation simulation(settings, listOf({plate}));
  const Vector3d before = momentumOfFluid(simulation);
  for (int step = 0; step < 60; ++step) ASSERT_TRUE(simulation.advance()) << simulation.halted();
  const Vector3d ofPlate = 500 * 0.6 * 0.11 * 0.6 * simulation.movingBodies().twist(0).head<3>();
  EXPECT_GT(ofPlate.x(), 0.05 * before.x()) << "it is dragged along";
  EXPECT_LT((momentumOfFluid(simulation) + ofPlate - before).norm(), 2e-3 * before.norm());
}

TEST(MovingBodies, MeetEachOtherAndTheContainer) {
  v1::Simulation settings = pool(4, 3);
  set(settings.mutable_container()->mutable_max(), {2, 2, 2});
  v1::Body shelf = box({1.5, 0.25, 1.5}, {0.6, 0.5, 0.6});
  const v1::Body lower = floatingBox({1.5, 0.8, 1.5}, {0.3, 0.3, 0.3}, 2000);
  const v1::Body upper = floatingBox({1.52, 1.4, 1.5}, {0.2, 0.2, 0.2}, 2000);
  const v1::Body onFloor = floatingBox({0.8, 0.5, 1.5}, {0.2, 0.2, 0.2}, 2000);
  FluidSimulation simulation(settings, listOf({shelf, lower, upper, onFloor}));
  runUntil(simulation, 2);
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_NEAR(simulation.movingBodies().centre(0).y(), 0.65, 0.01);
  EXPECT_NEAR(simulation.movingBodies().centre(1).y(), 0.9, 0.015);
  EXPECT_NEAR(simulation.movingBodies().centre(2).y(), 0.1, 0.01);
}

Bodies::List mixedBodies() {
  v1::Body paddle = box({0.3, 0.3, 0.4}, {0.11, 0.5, 0.5});
  paddle.mutable_driven()->mutable_rock()->set_y(40);
  paddle.mutable_driven()->set_period_seconds(0.5);
  paddle.set_friction(0.01);
  return listOf({floatingBox({1.1, 0.4, 0.4}, {0.3, 0.2, 0.2}, 300), paddle});
}

v1::Simulation damBreakBeside() {
  v1::Simulation settings = smallDamBreak();
  settings.mutable_fluids(0)->mutable_blocks(0)->mutable_velocity()->set_x(2);
  return settings;
}

void expectSame(const FluidSimulation& a, const FluidSimulation& b) {
  EXPECT_TRUE(a.state() == b.state());
  for (std::size_t k = 0; k < a.movingBodies().size(); ++k) {
    EXPECT_EQ(a.movingBodies().centre(k), b.movingBodies().centre(k));
    EXPECT_EQ(a.movingBodies().twist(k), b.movingBodies().twist(k));
  }
}

TEST(MovingBodies, SameBitsForAnyNumberOfThreadsAndOverSaving) {
  for (const char* solver : {"dfsph", "iisph", "pbf", "wcsph"}) {
    SCOPED_TRACE(solver);
    v1::Simulation settings = damBreakBeside();
    if (std::string(solver) == "iisph") settings.mutable_iisph();
    if (std::string(solver) == "pbf") settings.mutable_pbf();
    if (std::string(solver) == "wcsph") settings.mutable_wcsph();
    FluidSimulation one(settings, mixedBodies(), {.threads = 1});
    for (int step = 0; step < 60; ++step) ASSERT_TRUE(one.advance()) << one.halted();
    core::StateWriter out;
    one.save(out);
    FluidSimulation resumed(settings, mixedBodies(), {.threads = 2});
    ASSERT_TRUE(resumed.advance());
    core::StateReader in(out.bytes(), "state");
    resumed.resume(in);
    for (int step = 0; step < 30; ++step) ASSERT_TRUE(one.advance() && resumed.advance());
    expectSame(one, resumed);
    FluidSimulation four(settings, mixedBodies(), {.threads = 4});
    for (int step = 0; step < 90; ++step) ASSERT_TRUE(four.advance());
    expectSame(one, four);
    EXPECT_NE(one.movingBodies().twist(0).norm(), 0);
  }
}

TEST(MovingBodies, AreTakenBackWithAStepThatFails) {
  for (const char* solver : {"dfsph", "pbf"}) {
    v1::Simulation settings = damBreakBeside();
    if (std::string(solver) == "pbf") settings.mutable_pbf();
    // Fewer iterations than it takes.
    if (settings.has_pbf()) {
      settings.mutable_pbf()->set_iterations(1);
    } else {
      settings.mutable_dfsph()->set_max_iterations(2);
    }
    settings.mutable_time_step()->set_max_compression(1);
    settings.mutable_time_step()->set_min_seconds(1e-3);
    FluidSimulation simulation(settings, mixedBodies());
    Vector3d centre = simulation.movingBodies().centre(0);
    Vector6d twist = simulation.movingBodies().twist(0);
    for (int step = 0; step < 300 && simulation.advance(); ++step) {
      centre = simulation.movingBodies().centre(0);
      twist = simulation.movingBodies().twist(0);
    }
    ASSERT_NE(simulation.halted(), "") << solver;
    EXPECT_EQ(simulation.movingBodies().centre(0), centre);
    EXPECT_EQ(simulation.movingBodies().twist(0), twist);
    simulation.reset();
    EXPECT_LT((simulation.movingBodies().centre(0) - Vector3d(1.1, 0.4, 0.4)).norm(), 1e-6);
  }
}

TEST(MovingBodies, PlanTellsWhatTheyCost) {
  const auto reasons = [](const FluidSimulation& simulation) {
    std::string all;
    for (const core::LeftOut& left : simulation.plan().leftOut) all += left.name + ": " + left.reason + "\n";
    return all;
  };
  const FluidSimulation without(pool(4, 3));
  EXPECT_THAT(reasons(without), testing::HasSubstr("rigid bodies: none floats or is driven"));
  EXPECT_THAT(reasons(without), testing::HasSubstr("moving boundary: no body moves or has friction"));
  v1::Simulation wide = pool(4, 3);
  set(wide.mutable_container()->mutable_max(), {2, 2, 2});
  const FluidSimulation far(wide, listOf({floatingBox({1.5, 1.5, 1.5}, {0.2, 0.2, 0.2}, 500)}));
  EXPECT_THAT(reasons(far), testing::HasSubstr("moving boundary: no particle is near such a body"));
}

TEST(MassProperties, OfAMeshAreThoseOfTheBoxThatItIs) {
  const auto file = std::filesystem::path(testing::TempDir()) / "off_centre_box.obj";
  std::ofstream out(file);
  // A box of 2 × 1 × 3 from (1, 2, 3) on, its faces outwards.
  for (int k = 0; k < 8; ++k)
    out << "v " << 1 + 2 * (k & 1) << ' ' << 2 + (k >> 1 & 1) << ' ' << 3 + 3 * (k >> 2) << '\n';
  out << "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
  out.close();
  v1::Body mesh;
  mesh.mutable_mesh()->set_path(file.string());
  mesh.mutable_mesh()->set_scale(0.5);
  const auto of = [](const v1::Body& body) {
    return solids::massPropertiesOf(body, *solids::makeBodyShape(body, "bodies[0]"), "bodies[0]");
  };
  const solids::MassProperties found = of(mesh);
  const solids::MassProperties expected = of(box({0, 0, 0}, {1, 0.5, 1.5}));
  EXPECT_NEAR(found.volume, 0.75, 1e-12);
  EXPECT_LT((found.centre - Vector3d(1, 1.25, 2.25)).norm(), 1e-12);
  EXPECT_LT((found.inertia - expected.inertia).norm(), 1e-12);
}

TEST(MovingBodies, WithoutAVolumeCannotFloat) {
  v1::Body open = floatingBox({0.1, 0.5, 0.1}, {0.1, 0.1, 0.1}, 500);
  open.mutable_box()->set_open_top(true);
  try {
    const FluidSimulation simulation(pool(4, 3), listOf({open}));
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "bodies[0].floating");
  }
}

}  // namespace
}  // namespace sluice::sim
