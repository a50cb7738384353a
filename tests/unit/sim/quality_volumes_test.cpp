// Volumes of fluid at every quality: they stay as large as the scene says, inside the container and out of each other.

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "quality.h"
#include "scenes.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/scene.h"
#include "sluice/sim/simulation.h"
#include "sluice/solids/enclosure.h"

namespace sluice::sim {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kSpacing = 0.05;
constexpr std::array kOthers{"draft", "fine"};

/// Of the particles at the start, m³.
double volumeOf(const core::ParticleSource& simulation) {
  const auto snapshot = simulation.snapshot();
  return static_cast<double>(snapshot->size()) * std::pow(snapshot->spacing, 3);
}

void set(v1::Vec3* v, double x, double y, double z) {
  v->set_x(x);
  v->set_y(y);
  v->set_z(z);
}

v1::Block* addBlock(v1::Fluid* fluid, std::array<double, 3> first, std::array<std::uint32_t, 3> counts) {
  v1::Block* block = fluid->add_blocks();
  set(block->mutable_first_particle(), first[0], first[1], first[2]);
  block->set_count_x(counts[0]);
  block->set_count_y(counts[1]);
  block->set_count_z(counts[2]);
  return block;
}

/// A box of 2 m about the origin and a fluid without any volume.
v1::Scene emptyTank() {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_container()->mutable_min(), -1, -1, -1);
  set(simulation.mutable_container()->mutable_max(), 1, 1, 1);
  simulation.add_fluids();
  return sceneOf(simulation);
}

v1::Fluid* fluidOf(v1::Scene& scene) { return scene.mutable_simulation()->mutable_fluids(0); }

/// A stack of blocks that all but touch the mantle of a cylinder, as one would fill it by hand.
v1::Scene filledCylinder() {
  v1::Scene scene = emptyTank();
  v1::UprightContainer* cylinder = scene.mutable_simulation()->mutable_cylindrical_container();
  set(cylinder->mutable_base(), 0.013, -1, 0.007);
  cylinder->set_radius(0.6);
  cylinder->set_height(2);
  addBlock(fluidOf(scene), {0.013 - 0.375, -0.95, 0.007 - 0.375}, {16, 20, 16});
  addBlock(fluidOf(scene), {0.013 - 0.525, -0.95, 0.007 - 0.125}, {3, 20, 6});
  addBlock(fluidOf(scene), {0.013 + 0.425, -0.95, 0.007 - 0.125}, {3, 20, 6});
  return scene;
}

v1::Scene filledSphere() {
  v1::Scene scene = emptyTank();
  set(scene.mutable_simulation()->mutable_spherical_container()->mutable_centre(), 0, 0.3, 0);
  scene.mutable_simulation()->mutable_spherical_container()->set_radius(0.8);
  addBlock(fluidOf(scene), {-0.425, 0.3 - 0.425, -0.425}, {18, 18, 18});
  return scene;
}

/// A tilted floor.
v1::Scene filledWedge() {
  v1::Scene scene = emptyTank();
  v1::Plane* plane = scene.mutable_simulation()->add_planes();
  set(plane->mutable_point(), 0, -0.6, 0);
  set(plane->mutable_normal(), -0.3, 1, 0.1);
  addBlock(fluidOf(scene), {-0.9, -0.41, -0.6}, {20, 16, 26});
  return scene;
}

/// Off any lattice of the container, one block set off from the other by a part of a spacing.
v1::Scene setOffBlocks() {
  v1::Scene scene = emptyTank();
  addBlock(fluidOf(scene), {-0.9371, -0.9123, -0.9287}, {14, 20, 17});
  addBlock(fluidOf(scene), {-0.9371 + 14 * kSpacing + 0.0317, -0.9411, -0.9287}, {11, 9, 17});
  return scene;
}

/// Balls beside a block and up against the faces.
v1::Scene ballsAndBlock() {
  v1::Scene scene = emptyTank();
  addBlock(fluidOf(scene), {-0.95, -0.95, -0.95}, {39, 12, 39});
  const auto addBall = [&](double x, double y, double z, double radius) {
    v1::Ball* ball = fluidOf(scene)->add_balls();
    set(ball->mutable_centre(), x, y, z);
    ball->set_radius(radius);
  };
  addBall(0, 0.1, 0, 0.46);
  addBall(0.58, 0.58, -0.58, 0.39);
  return scene;
}

/// An octahedron between the pool and the top of the container.
v1::Scene meshAndBlock() {
  v1::Scene scene = emptyTank();
  const auto file = std::filesystem::path(testing::TempDir()) / "quality_octahedron.obj";
  std::ofstream(file) << "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                      << "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
  addBlock(fluidOf(scene), {-0.95, -0.95, -0.95}, {39, 8, 39});
  v1::MeshVolume* mesh = fluidOf(scene)->add_meshes();
  mesh->set_path(file.string());
  set(mesh->mutable_position(), 0.02, 0.2, 0.01);
  mesh->set_scale(0.77);
  return scene;
}

/// Thinner than the layers of a draft, one on the other.
v1::Scene thinLayers() {
  v1::Scene scene = emptyTank();
  for (int k = 0; k < 9; ++k) addBlock(fluidOf(scene), {-0.95, -0.95 + k * kSpacing, -0.95}, {39, 1, 39});
  return scene;
}

struct Filled {
  const char* name;
  v1::Scene (*scene)();
};

const std::array kFilled{Filled{"cylinder", filledCylinder},
                         Filled{"sphere", filledSphere},
                         Filled{"wedge", filledWedge},
                         Filled{"set_off_blocks", setOffBlocks},
                         Filled{"balls_and_block", ballsAndBlock},
                         Filled{"mesh_and_block", meshAndBlock},
                         Filled{"thin_layers", thinLayers}};

class VolumesAtQuality : public testing::TestWithParam<std::tuple<Filled, const char*>> {};

/// The scene at full quality, and at the tested one.
TEST_P(VolumesAtQuality, KeepTheirSizeInsideTheContainer) {
  v1::Scene scene = std::get<0>(GetParam()).scene();
  const double full = volumeOf(*makeSimulation(scene, 1));
  scene.set_quality(std::get<1>(GetParam()));
  const auto simulation = makeSimulation(scene, 1);
  EXPECT_NEAR(volumeOf(*simulation) / full, 1, 0.05);
  const solids::Enclosure container(scene.simulation());
  const auto snapshot = simulation->snapshot();
  for (const Eigen::Vector3f& x : snapshot->positions) {
    ASSERT_GE(container.distance(x.cast<double>()), 0.98 * snapshot->spacing);
  }
}

TEST_P(VolumesAtQuality, RunOn) {
  v1::Scene scene = std::get<0>(GetParam()).scene();
  scene.set_quality(std::get<1>(GetParam()));
  const auto simulation = makeSimulation(scene, 2);
  for (int step = 0; step < 3; ++step) ASSERT_TRUE(simulation->advance()) << simulation->halted();
  EXPECT_LT(simulation->statistics().maxDensityError, 0.2) << "no particle starts in another";
}

INSTANTIATE_TEST_SUITE_P(All, VolumesAtQuality,
                         testing::Combine(testing::ValuesIn(kFilled), testing::ValuesIn(kOthers)),
                         [](const auto& tested) {
                           return std::string(std::get<0>(tested.param).name) + "_" + std::get<1>(tested.param);
                         });

std::vector<std::string> filledScenes() {
  std::vector<std::string> names;
  for (const scene::ShippedScene& shipped : scene::shippedScenes()) {
    const v1::Scene scene = scene::loadShipped(shipped.name);
    for (const v1::Fluid& fluid : scene.simulation().fluids()) {
      if (fluid.blocks().empty()) continue;
      names.push_back(shipped.name);
      break;
    }
  }
  return names;
}

class ShippedVolumesAtQuality : public testing::TestWithParam<std::tuple<std::string, const char*>> {};

TEST_P(ShippedVolumesAtQuality, KeepTheirSize) {
  v1::Scene scene = scene::loadShipped(std::get<0>(GetParam()));
  const auto full = makeSimulation(scene, 1);
  scene.set_quality(std::get<1>(GetParam()));
  const auto other = makeSimulation(scene, 1);
  EXPECT_NEAR(volumeOf(*other) / volumeOf(*full), 1, 0.04);
  const double factor = scene.quality() == "draft" ? 1.0 / 3 : 3;
  const double particles =
      static_cast<double>(other->snapshot()->size()) / static_cast<double>(full->snapshot()->size());
  EXPECT_NEAR(particles / factor, 1, 0.2);
  EXPECT_THAT(other->notices(), testing::Each(testing::Not(HasSubstr("left out"))))
      << "shipped scenes fit at every quality";
}

INSTANTIATE_TEST_SUITE_P(All, ShippedVolumesAtQuality,
                         testing::Combine(testing::ValuesIn(filledScenes()), testing::ValuesIn(kOthers)),
                         [](const auto& tested) {
                           return std::get<0>(tested.param) + "_" + std::get<1>(tested.param);
                         });

TEST(QualityVolumes, WhatIsLeftOutIsSaid) {
  v1::Scene scene = thinLayers();
  EXPECT_THAT(makeSimulation(scene, 1)->notices(), testing::IsEmpty());
  scene.set_quality("draft");
  EXPECT_THAT(makeSimulation(scene, 1)->notices(), Contains(HasSubstr("were left out that the scene's volumes")));
}

// A block that would be cut at draft until it fits is refused like the full one.
TEST(QualityVolumes, ThatStandOutOfTheContainerAreRefusedAtEveryQuality) {
  for (const char* quality : {"draft", "full", "fine"}) {
    const auto expectRefused = [&](v1::Scene scene, const std::string& place) {
      scene.set_quality(quality);
      try {
        makeSimulation(scene, 1);
        ADD_FAILURE() << place << " taken at " << quality;
      } catch (const core::InputError& error) {
        EXPECT_EQ(error.fieldPath(), place);
        EXPECT_THAT(error.problem(), HasSubstr("particles must start one spacing inside"));
      }
    };
    v1::Scene box = setOffBlocks();
    fluidOf(box)->mutable_blocks(1)->set_count_x(40);
    expectRefused(box, "simulation.fluids[0].blocks[1].first_particle");
    v1::Scene sphere = filledSphere();
    fluidOf(sphere)->mutable_blocks(0)->set_count_z(22);
    expectRefused(sphere, "simulation.fluids[0].blocks[0].first_particle");
    v1::Scene ball = ballsAndBlock();
    fluidOf(ball)->mutable_balls(1)->set_radius(0.5);
    expectRefused(ball, "simulation.fluids[0].balls[1].centre");
  }
}

TEST(QualityVolumes, ABlockThatFillsTheBudgetStillDoes) {
  for (const char* quality : kOthers) {
    v1::Scene scene = setOffBlocks();
    scene.mutable_simulation()->set_max_particles(14 * 20 * 17 + 11 * 9 * 17);
    scene.set_quality(quality);
    EXPECT_NO_THROW(makeSimulation(scene, 1)) << quality;
  }
}

TEST(QualityVolumes, AFluidThatFacesLeaveNothingOfIsRefused) {
  v1::Scene scene = emptyTank();
  set(scene.mutable_simulation()->mutable_spherical_container()->mutable_centre(), 0, 0, 0);
  scene.mutable_simulation()->mutable_spherical_container()->set_radius(0.051);
  addBlock(fluidOf(scene), {0, 0, 0}, {1, 1, 1});
  EXPECT_NO_THROW(makeSimulation(scene, 1));
  scene.set_quality("draft");
  try {
    makeSimulation(scene, 1);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.fieldPath(), HasSubstr("simulation."));
  }
}

}  // namespace
}  // namespace sluice::sim
