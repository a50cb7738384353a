// What holds the fluid, besides boxes: spheres, cylinders and planes with exact distances.

#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// A cube of water whose middle is at the origin.
v1::Simulation waterCube(int across, const Vector3d& velocity, double spacing = kSpacing) {
  v1::Simulation settings = smallDamBreak();
  settings.set_particle_spacing(spacing);
  settings.clear_container();
  v1::Block* block = settings.mutable_fluids(0)->mutable_blocks(0);
  const double first = -0.5 * spacing * (across - 1);
  set(block->mutable_first_particle(), first, first, first);
  for (const auto setCount : {&v1::Block::set_count_x, &v1::Block::set_count_y, &v1::Block::set_count_z}) {
    (block->*setCount)(static_cast<std::uint32_t>(across));
  }
  set(block->mutable_velocity(), velocity.x(), velocity.y(), velocity.z());
  return settings;
}

void addPlane(v1::Simulation& settings, const Vector3d& point, const Vector3d& normal) {
  v1::Plane* plane = settings.add_planes();
  set(plane->mutable_point(), point.x(), point.y(), point.z());
  set(plane->mutable_normal(), normal.x(), normal.y(), normal.z());
}

struct Case {
  const char* name;
  std::function<void(v1::Simulation&)> hold;
  /// Of a point, to the nearest face, m: written out here once more.
  std::function<double(const Vector3d&)> distance;
};

void PrintTo(const Case& kind, std::ostream* out) { *out << kind.name; }

void putInBox(v1::Simulation& settings) {
  set(settings.mutable_container()->mutable_min(), -0.6, -0.6, -0.6);
  set(settings.mutable_container()->mutable_max(), 0.6, 0.6, 0.6);
}

double inBox(const Vector3d& x) { return 0.6 - x.cwiseAbs().maxCoeff(); }

const double kHalf = std::sqrt(0.5);

const Case kCases[] = {
    {"sphere", [](v1::Simulation& settings) { settings.mutable_spherical_container()->set_radius(0.6); },
     [](const Vector3d& x) { return 0.6 - x.norm(); }},
    {"cylinder",
     [](v1::Simulation& settings) {
       set(settings.mutable_cylindrical_container()->mutable_base(), 0, -0.5, 0);
       settings.mutable_cylindrical_container()->set_radius(0.4);
       settings.mutable_cylindrical_container()->set_height(1.2);
     },
     [](const Vector3d& x) {
       return std::min({0.4 - std::hypot(x.x(), x.z()), x.y() + 0.5, 0.7 - x.y()});
     }},
    {"valley_of_planes",
     [](v1::Simulation& settings) {
       putInBox(settings);
       addPlane(settings, {0, -0.6, 0}, {1, 1, 0});
       addPlane(settings, {0, -0.6, 0}, {-1, 1, 0});
     },
     [](const Vector3d& x) {
       const double right = kHalf * (x.x() + x.y() + 0.6);
       const double left = kHalf * (-x.x() + x.y() + 0.6);
       return std::min({inBox(x), right, left});
     }},
};

class Container3D : public testing::TestWithParam<Case> {
 protected:
  static v1::Simulation held(v1::Simulation settings) {
    GetParam().hold(settings);
    if (settings.has_spherical_container()) set(settings.mutable_spherical_container()->mutable_centre(), 0, 0, 0);
    return settings;
  }
};

TEST_P(Container3D, IsSampledOnItsFaces) {
  const FluidSimulation simulation(held(waterCube(8, {0, 0, 0})));
  const Vector3d origin = Vector3d::Constant(-0.6);
  const Vector3d corner = std::string(GetParam().name) == "cylinder" ? Vector3d(-0.4, -0.5, -0.4) : origin;
  EXPECT_GT(simulation.boundary().size(), 1000U);
  std::size_t onFace = 0;
  for (const Float4& p : simulation.boundary().points()) {
    const double distance = GetParam().distance(corner + Vector3d(p.x, p.y, p.z));
    EXPECT_LT(distance, 1e-5) << "a sample in the fluid";
    EXPECT_GE(distance, -2 * kSpacing - 1e-5) << "a sample that nothing feels";
    if (std::abs(distance) < 1e-5) ++onFace;
  }
  EXPECT_GT(onFace, simulation.boundary().size() / 2);
}

// At the largest steps that the schema allows, in every direction.
TEST_P(Container3D, HoldsFastFluid) {
  for (const Vector3d& velocity : {Vector3d(0, -12, 0), Vector3d(9, 5, -7), Vector3d(-3, 11, 3)}) {
    v1::Simulation settings = held(waterCube(7, velocity));
    settings.mutable_time_step()->set_cfl(1);
    FluidSimulation simulation(settings);
    for (int step = 0; step < 150; ++step) {
      ASSERT_TRUE(simulation.advance()) << simulation.halted();
      if (step % 10 != 0) continue;
      const auto snapshot = simulation.snapshot();
      for (const Eigen::Vector3f& x : snapshot->positions) {
        ASSERT_GT(GetParam().distance(x.cast<double>()), 0.45 * kSpacing) << x.transpose();
      }
    }
  }
}

// By least squares over particles that are away from walls and surface; 15 % as in a box, see
// Physics.PressureInAColumnGrowsWithDepth.
TEST_P(Container3D, PressureGrowsWithDepth) {
  constexpr double kFine = 0.035;
  v1::Simulation settings = held(waterCube(15, {0, 0, 0}, kFine));
  settings.mutable_dfsph()->set_density_error(0.005);
  settings.mutable_fluids(0)->set_viscosity(0.05);
  FluidSimulation simulation(settings);
  runUntil(simulation, 2.5);
  double highest = -1;
  const auto settled = simulation.snapshot();
  for (const Eigen::Vector3f& x : settled->positions) highest = std::max(highest, static_cast<double>(x.y()));
  const double gradient = pressureGradient(simulation, [&](const Vector3d& x) {
    return GetParam().distance(x) >= 2.5 * kFine && x.y() <= highest - 1.5 * kFine;
  });
  EXPECT_NEAR(gradient, 1, 0.15);
  EXPECT_LT(simulation.statistics().maxDensityError, 0.15);
}

TEST_P(Container3D, SameBitsForAnyNumberOfThreads) {
  const v1::Simulation settings = held(waterCube(8, {2, -1, 0}));
  const auto after = [&](int threads) {
    FluidSimulation simulation(settings, {.threads = threads});
    for (int step = 0; step < 60; ++step) EXPECT_TRUE(simulation.advance());
    return simulation.state();
  };
  const ParticleState one = after(1);
  for (const int threads : {2, 4}) EXPECT_TRUE(after(threads) == one) << threads << " threads";
}

INSTANTIATE_TEST_SUITE_P(Every, Container3D, testing::ValuesIn(kCases),
                         [](const auto& kind) { return std::string(kind.param.name); });

std::string errorOf(const v1::Simulation& settings) {
  try {
    const FluidSimulation simulation(settings);
  } catch (const core::InputError& error) {
    return error.fieldPath();
  }
  return "taken";
}

TEST(Containers, RefuseWhatCannotBe) {
  v1::Simulation small = waterCube(3, {0, 0, 0});
  small.mutable_spherical_container()->set_radius(0.04);
  EXPECT_EQ(errorOf(small), "simulation.spherical_container.radius");

  v1::Simulation outside = waterCube(20, {0, 0, 0});
  set(outside.mutable_spherical_container()->mutable_centre(), 0, 0, 0);
  outside.mutable_spherical_container()->set_radius(0.6);
  EXPECT_EQ(errorOf(outside), "simulation.fluids[0].blocks[0].first_particle") << "its corners are outside";

  v1::Simulation behind = waterCube(3, {0, 0, 0});
  putInBox(behind);
  addPlane(behind, {0, 2, 0}, {0, 1, 0});
  EXPECT_EQ(errorOf(behind), "simulation.planes[0]");

  v1::Simulation planar = waterCube(1, {0, 0, 0});
  planar.mutable_spherical_container();
  planar.set_planar(true);
  EXPECT_EQ(errorOf(planar), "simulation.planar");
}

// A plane in the place of a box's floor changes next to nothing: the same samples, counted together.
TEST(Containers, APlaneStandsInForAFace) {
  v1::Simulation low = column(8, 8);
  const FluidSimulation floor(low);
  low.mutable_container()->mutable_min()->set_y(-0.5);
  addPlane(low, {0, 0, 0}, {0, 1, 0});
  const FluidSimulation plane(low);
  double largest = 0;
  for (std::size_t i = 0; i < floor.state().size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(plane.neighbours().density()[i]) - 1));
  }
  EXPECT_LT(largest, 0.15) << "Akinci's volumes do not know angles: edges weigh a little more";
}

}  // namespace
}  // namespace sluice::sim
