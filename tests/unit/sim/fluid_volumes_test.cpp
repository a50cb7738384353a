// Balls and meshes full of particles, and what is refused of them.

#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

using testing::HasSubstr;

/// A fluid without any volume in a container of 2 m about the origin, without gravity.
v1::Simulation weightlessTank() {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, 0, 0);
  set(simulation.mutable_container()->mutable_min(), -1, -1, -1);
  set(simulation.mutable_container()->mutable_max(), 1, 1, 1);
  simulation.add_fluids();
  return simulation;
}

v1::Ball* addBall(v1::Simulation& simulation, double x, double y, double z, double radius) {
  v1::Ball* ball = simulation.mutable_fluids(0)->add_balls();
  set(ball->mutable_centre(), x, y, z);
  ball->set_radius(radius);
  return ball;
}

/// The file of an octahedron with corners at 1 on the axes; one that is open lacks a face.
std::string octahedron(bool open) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / (open ? "open_octahedron.obj" : "octahedron.obj");
  std::ofstream out(file);
  out << "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
      << "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\n";
  if (!open) out << "f 1 4 6\n";
  return file.string();
}

v1::MeshVolume* addMesh(v1::Simulation& simulation, double scale, bool open = false) {
  v1::MeshVolume* mesh = simulation.mutable_fluids(0)->add_meshes();
  mesh->set_path(octahedron(open));
  mesh->set_scale(scale);
  return mesh;
}

/// Calls `check` with each particle's place in the scene and its velocity.
template <class Check>
void forEach(const FluidSimulation& simulation, Check&& check) {
  const auto snapshot = simulation.snapshot();
  for (std::size_t i = 0; i < snapshot->size(); ++i) check(snapshot->positions[i], snapshot->velocities[i]);
}

TEST(Ball, HoldsTheParticlesOfItsVolume) {
  v1::Simulation settings = weightlessTank();
  addBall(settings, 0.1, -0.05, 0, 0.5)->mutable_velocity()->set_y(3);
  const FluidSimulation simulation(settings);
  const double expected = 4 * std::numbers::pi / 3 * std::pow(0.5 / kSpacing, 3);
  EXPECT_NEAR(static_cast<double>(simulation.state().size()), expected, 0.02 * expected);
  forEach(simulation, [](const auto& x, const auto& v) {
    EXPECT_LT((x - Eigen::Vector3f(0.1F, -0.05F, 0)).norm(), 0.5F);
    EXPECT_EQ(v, Eigen::Vector3f(0, 3, 0));
  });
}

TEST(Ball, IsAtRestDensityInside) {
  v1::Simulation settings = weightlessTank();
  addBall(settings, 0, 0, 0, 0.4);
  const auto snapshot = FluidSimulation(settings).snapshot();
  int inner = 0;
  for (std::size_t i = 0; i < snapshot->size(); ++i) {
    if (snapshot->positions[i].norm() > 0.25F) continue;
    ++inner;
    EXPECT_NEAR(snapshot->densities[i], 1000, 0.1);
  }
  EXPECT_GT(inner, 400);
}

TEST(Ball, FillsAPlanarSceneAsADisc) {
  v1::Simulation settings = weightlessTank();
  settings.set_planar(true);
  addBall(settings, 0, 0, 0.3, 0.5);
  const FluidSimulation simulation(settings);
  const double expected = std::numbers::pi * std::pow(0.5 / kSpacing, 2);
  EXPECT_NEAR(static_cast<double>(simulation.state().size()), expected, 0.03 * expected);
  forEach(simulation, [](const auto& x, const auto&) { EXPECT_FLOAT_EQ(x.z(), 0.3F); });
  addBall(settings, 0, 0.6, 0, 0.1);
  expectRefused(settings, "simulation.fluids[0].balls[1].centre.z", "planar");
}

TEST(Ball, ReachingIntoAWallIsRefused) {
  v1::Simulation settings = weightlessTank();
  addBall(settings, 0.7, 0, 0, 0.32);
  expectRefused(settings, "simulation.fluids[0].balls[0].centre", "within [-0.95, 0.95] m");
  settings.mutable_fluids(0)->mutable_balls(0)->set_radius(5000);
  expectRefused(settings, "simulation.fluids[0].balls[0].centre", "within [-0.95, 0.95] m");
}

TEST(Ball, TooSmallForAParticleIsRefused) {
  v1::Simulation settings = weightlessTank();
  addBall(settings, 0.025, 0.025, 0.025, 0.02);
  expectRefused(settings, "simulation.fluids[0].balls[0]", "holds no particle");
}

TEST(Ball, OfMoreParticlesThanMemoryIsRefusedBeforeAnyIsMade) {
  v1::Simulation settings = weightlessTank();
  addBall(settings, 0, 0, 0, 0.5);
  try {
    const FluidSimulation simulation(settings, {.availableMemory = 1 << 20});
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "simulation.fluids[0].balls[0]");
    EXPECT_THAT(error.problem(), HasSubstr("memory allows"));
  }
}

TEST(MeshVolume, OfMoreParticlesThanMemoryIsRefused) {
  v1::Simulation settings = weightlessTank();
  addMesh(settings, 0.9);
  try {
    const FluidSimulation simulation(settings, {.availableMemory = 1 << 20});
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "simulation.fluids[0].meshes[0]");
    EXPECT_THAT(error.problem(), HasSubstr("memory allows"));
  }
}

TEST(Volumes, OfAnyKindMustNotOverlap) {
  v1::Simulation settings = weightlessTank();
  addBall(settings, 0, 0, 0, 0.3);
  addBall(settings, 0.4, 0, 0, 0.3);
  expectRefused(settings, "simulation.fluids[0].balls[1].centre", "the ball overlaps simulation.fluids[0].balls[0]");
  settings.mutable_fluids(0)->mutable_balls()->RemoveLast();
  addMesh(settings, 0.4)->mutable_position()->set_y(0.5);
  expectRefused(settings, "simulation.fluids[0].meshes[0].position", "the mesh overlaps simulation.fluids[0].balls[0]");
  settings.mutable_fluids(0)->clear_meshes();
  v1::Block* block = settings.mutable_fluids(0)->add_blocks();
  set(block->mutable_first_particle(), 0.01, 0.01, 0.01);
  expectRefused(settings, "simulation.fluids[0].balls[0].centre", "overlaps simulation.fluids[0].blocks[0]");
}

TEST(Volumes, OfOneLatticeFitTogetherSideBySide) {
  v1::Simulation settings = weightlessTank();
  addBall(settings, -0.3, 0, 0, 0.3);
  addBall(settings, 0.3, 0, 0, 0.3);
  EXPECT_NO_THROW(FluidSimulation{settings});
}

TEST(Volumes, AFluidWithoutAnyIsRefused) {
  expectRefused(weightlessTank(), "simulation.fluids[0]", "needs at least one");
  v1::Simulation settings = smallDamBreak();
  settings.add_fluids();
  expectRefused(settings, "simulation.fluids[1]", "needs at least one");
}

TEST(Volumes, MoreThanTheScenesOwnBudgetAreRefused) {
  v1::Simulation settings = smallDamBreak();
  settings.set_max_particles(2999);
  expectRefused(settings, "simulation.max_particles", "starts with 3000 particles");
  settings.set_max_particles(3000);
  EXPECT_NO_THROW(FluidSimulation{settings});
}

TEST(MeshVolume, HoldsTheParticlesThatItEncloses) {
  v1::Simulation settings = weightlessTank();
  v1::MeshVolume* mesh = addMesh(settings, 0.6);
  set(mesh->mutable_position(), 0.013, -0.1, 0.07);
  mesh->mutable_velocity()->set_x(-2);
  const FluidSimulation simulation(settings);
  const double expected = 4.0 / 3 * std::pow(0.6 / kSpacing, 3);
  EXPECT_NEAR(static_cast<double>(simulation.state().size()), expected, 0.02 * expected);
  forEach(simulation, [](const auto& x, const auto& v) {
    EXPECT_LT((x - Eigen::Vector3f(0.013F, -0.1F, 0.07F)).template lpNorm<1>(), 0.6F);
    EXPECT_EQ(v, Eigen::Vector3f(-2, 0, 0));
  });
}

TEST(MeshVolume, TurnsWithItsRotation) {
  v1::Simulation settings = weightlessTank();
  addMesh(settings, 0.6)->mutable_rotation_degrees()->set_z(45);
  const double diagonal = std::numbers::sqrt2 / 2;
  const FluidSimulation simulation(settings);
  ASSERT_GT(simulation.state().size(), 1000U);
  forEach(simulation, [&](const auto& x, const auto&) {
    const double u = diagonal * (x.x() + x.y());
    const double v = diagonal * (x.y() - x.x());
    EXPECT_LT(std::abs(u) + std::abs(v) + std::abs(x.z()), 0.6 + 1e-6);
  });
}

TEST(MeshVolume, OpenOrMissingIsRefused) {
  v1::Simulation settings = weightlessTank();
  addMesh(settings, 0.6, true);
  expectRefused(settings, "simulation.fluids[0].meshes[0].path", "open surface");
  settings.mutable_fluids(0)->mutable_meshes(0)->set_path("no_such_file.obj");
  expectRefused(settings, "simulation.fluids[0].meshes[0].path", "no_such_file.obj");
}

TEST(MeshVolume, OutsideTheContainerIsRefused) {
  v1::Simulation settings = weightlessTank();
  addMesh(settings, 0.6)->mutable_position()->set_z(0.8);
  expectRefused(settings, "simulation.fluids[0].meshes[0].position", "the mesh has a particle at z = 1 m");
  settings.mutable_fluids(0)->mutable_meshes(0)->mutable_position()->set_z(8);
  expectRefused(settings, "simulation.fluids[0].meshes[0]", "holds no particle");
}

}  // namespace
}  // namespace sluice::sim
