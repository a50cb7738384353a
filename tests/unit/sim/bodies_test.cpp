#include "bodies.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "boundary.h"
#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kSpacing = 0.05;

void set(v1::Vec3* v, double x, double y, double z) {
  v->set_x(x);
  v->set_y(y);
  v->set_z(z);
}

v1::Body bodyAt(double x, double y, double z) {
  v1::Body body;
  body.set_name("wall");
  set(body.mutable_position(), x, y, z);
  return body;
}

v1::Body box(const Vector3d& middle, const Vector3d& size, bool openTop = false) {
  v1::Body body = bodyAt(middle.x(), middle.y(), middle.z());
  set(body.mutable_box()->mutable_size(), size.x(), size.y(), size.z());
  body.mutable_box()->set_open_top(openTop);
  return body;
}

v1::Body cylinder(const Vector3d& middle, double radius, double height, bool openTop = false) {
  v1::Body body = bodyAt(middle.x(), middle.y(), middle.z());
  body.mutable_cylinder()->set_radius(radius);
  body.mutable_cylinder()->set_height(height);
  body.mutable_cylinder()->set_open_top(openTop);
  return body;
}

v1::Body sphere(const Vector3d& middle, double radius) {
  v1::Body body = bodyAt(middle.x(), middle.y(), middle.z());
  body.mutable_sphere()->set_radius(radius);
  return body;
}

/// A tetrahedron with edges of `edge` m, without its last face where it is open.
v1::Body tetrahedron(const Vector3d& middle, double edge, bool open) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / (open ? "open_tetrahedron.obj" : "tetrahedron.obj");
  std::ofstream(file) << "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\n"
                      << (open ? "" : "f 2 4 3\n");
  v1::Body body = bodyAt(middle.x(), middle.y(), middle.z());
  body.mutable_mesh()->set_path(file.string());
  body.mutable_mesh()->set_scale(edge / std::sqrt(8));
  return body;
}

Bodies::List listOf(std::initializer_list<v1::Body> bodies) {
  Bodies::List list;
  for (const v1::Body& body : bodies) *list.Add() = body;
  return list;
}

/// 2 m wide, with room for the fluid of a block.
v1::Simulation emptyTank() {
  v1::Simulation simulation = smallDamBreak();
  set(simulation.mutable_container()->mutable_min(), -1, -1, -1);
  set(simulation.mutable_container()->mutable_max(), 1, 1, 1);
  simulation.mutable_fluids(0)->clear_blocks();
  return simulation;
}

void addBlock(v1::Simulation& simulation, const Vector3d& first, int nx, int ny, int nz, const Vector3d& velocity) {
  v1::Block* block = simulation.mutable_fluids(0)->add_blocks();
  set(block->mutable_first_particle(), first.x(), first.y(), first.z());
  block->set_count_x(static_cast<std::uint32_t>(nx));
  block->set_count_y(static_cast<std::uint32_t>(ny));
  block->set_count_z(static_cast<std::uint32_t>(nz));
  set(block->mutable_velocity(), velocity.x(), velocity.y(), velocity.z());
}

/// About the middle of emptyTank().
std::vector<Vector3d> samplesOf(const v1::Body& body, double support = 2 * kSpacing) {
  const Container container{{-1, -1, -1}, {2, 2, 2}, {}};
  const Discretisation discretisation{3, KernelKind::CubicSpline, kSpacing, support, 1};
  std::vector<Vector3d> points;
  for (const auto& s : Bodies(listOf({body}), container, discretisation, boundaryLayers(discretisation)).samples()) {
    points.emplace_back(s.position.x - 1.0, s.position.y - 1.0, s.position.z - 1.0);
  }
  return points;
}

/// Runs, and calls `check` with where each particle is in the scene.
template <class Check>
void forEachParticle(const FluidSimulation& simulation, Check&& check) {
  const auto snapshot = simulation.snapshot();
  for (const Eigen::Vector3f& x : snapshot->positions) check(Vector3d(x.cast<double>()));
}

TEST(Bodies, SamplesAreAboutOneSpacingApartAndCoverTheSurface) {
  struct Case {
    v1::Body body;
    double area;
  };
  const double edge = 0.8;
  for (const auto& [body, area] :
       {Case{box({0, 0, 0}, {0.6, 0.43, 0.37}), 2 * (0.6 * 0.43 + 0.43 * 0.37 + 0.37 * 0.6)},
        Case{box({0, 0, 0}, {0.6, 0.43, 0.37}, true), 2 * (0.6 * 0.43 + 0.43 * 0.37) + 0.37 * 0.6},
        Case{sphere({0, 0, 0}, 0.33), 4 * std::numbers::pi * 0.33 * 0.33},
        Case{cylinder({0, 0, 0}, 0.3, 0.7), 2 * std::numbers::pi * 0.3 * (0.7 + 0.3)},
        Case{cylinder({0, 0, 0}, 0.3, 0.7, true), 2 * std::numbers::pi * 0.3 * (0.7 + 0.15)},
        Case{tetrahedron({0, 0, 0}, edge, false), std::sqrt(3) * edge * edge}}) {
    const std::vector<Vector3d> points = samplesOf(body);
    SCOPED_TRACE(body.ShortDebugString());
    EXPECT_NEAR(static_cast<double>(points.size()), area / (kSpacing * kSpacing), 0.15 * area / (kSpacing * kSpacing));
    for (const Vector3d& p : points) {
      double nearest = 1;
      for (const Vector3d& q : points) {
        if (&p != &q) nearest = std::min(nearest, (p - q).norm());
      }
      ASSERT_GE(nearest, 0.7 * kSpacing) << p.transpose();
      ASSERT_LE(nearest, 1.3 * kSpacing) << p.transpose();
    }
  }
}

TEST(Bodies, SamplesOfRoundBodiesAreTheSameAboveAndBelow) {
  for (const v1::Body& body : {sphere({0, 0, 0}, 0.33), cylinder({0, 0, 0}, 0.3, 0.7)}) {
    Vector3d sum = Vector3d::Zero();
    const std::vector<Vector3d> points = samplesOf(body);
    for (const Vector3d& p : points) sum += p;
    EXPECT_LT(sum.norm() / static_cast<double>(points.size()), 0.02 * kSpacing);
    EXPECT_NEAR(sum.y(), 0, 1e-4);
  }
}

TEST(Bodies, WideSupportsHaveSolidWallsOfSeveralLayersAndThinOnesOfOne) {
  for (const v1::Body& body : {box({0, 0, 0}, {0.6, 0.6, 0.6}), sphere({0, 0, 0}, 0.3), cylinder({0, 0, 0}, 0.3, 0.6),
                               tetrahedron({0, 0, 0}, 1.2, false)}) {
    SCOPED_TRACE(body.ShortDebugString());
    EXPECT_GT(static_cast<double>(samplesOf(body, 4 * kSpacing).size()),
              1.7 * static_cast<double>(samplesOf(body).size()));
    v1::Body glass = body;
    glass.mutable_glass();
    EXPECT_EQ(samplesOf(glass, 4 * kSpacing).size(), samplesOf(body).size());
  }
}

TEST(Bodies, StandWhereTheScenePutsThem) {
  v1::Body body = box({0.3, -0.2, 0.1}, {0.8, 0.1, 0.2});
  set(body.mutable_rotation_degrees(), 0, 0, 90);
  for (const Vector3d& p : samplesOf(body)) {
    const Vector3d from = (p - Vector3d(0.3, -0.2, 0.1)).cwiseAbs();
    EXPECT_LE(from.x(), 0.05 + 1e-5);
    EXPECT_LE(from.y(), 0.4 + 1e-5);
    EXPECT_LE(from.z(), 0.1 + 1e-5);
  }
}

TEST(Bodies, InsideAndNearAreToldForEveryShape) {
  const Container container{{-1, -1, -1}, {2, 2, 2}, {}};
  const Discretisation discretisation{3, KernelKind::CubicSpline, kSpacing, 2 * kSpacing, 1};
  const Vector3d middle(1, 1, 1);
  for (const v1::Body& body : {box({0, 0, 0}, {0.6, 0.6, 0.6}), sphere({0, 0, 0}, 0.3), cylinder({0, 0, 0}, 0.3, 0.6),
                               tetrahedron({0, 0, 0}, 1.0, false)}) {
    SCOPED_TRACE(body.ShortDebugString());
    v1::Body glass = body;
    glass.mutable_glass();
    const Bodies bodies(listOf({body}), container, discretisation, 1);
    const Bodies hollow(listOf({glass}), container, discretisation, 1);
    EXPECT_TRUE(bodies.bodyAt(middle, 0.025));
    EXPECT_FALSE(hollow.bodyAt(middle, 0.025));
    EXPECT_FALSE(bodies.bodyAt(middle + Vector3d(0, 0, 0.7), 0.025));
    const solids::ClosestPoint closest = bodies.closest(middle + Vector3d(0.02, 0.03, 0.01), 1, 1);
    EXPECT_TRUE(hollow.bodyAt(closest.point, 0.025));
  }
}

TEST(Bodies, ParticlesInsideAreTakenOutAndCounted) {
  v1::Simulation settings = emptyTank();
  addBlock(settings, {-0.2, -0.9, -0.2}, 9, 9, 9, {0, 0, 0});
  const FluidSimulation simulation(settings, listOf({sphere({0, -0.7, 0}, 0.1)}));
  const std::size_t left = simulation.state().size();
  std::size_t expected = 0;
  for (int place = 0; place < 729; ++place) {
    const Vector3d from = kSpacing * Vector3d(place % 9 - 4, place / 9 % 9 - 4, place / 81 - 4);
    if (from.norm() > 0.1 + 0.5 * kSpacing - 1e-3) ++expected;
  }
  EXPECT_EQ(left, expected);
  EXPECT_THAT(simulation.notices(), ElementsAre(HasSubstr(std::to_string(729 - left) + " particles were taken out")));
  EXPECT_THAT(simulation.notices(), ElementsAre(HasSubstr("bodies[0] (wall)")));
  forEachParticle(simulation, [](const Vector3d& x) { EXPECT_GE((x - Vector3d(0, -0.7, 0)).norm(), 0.1 + 0.0247); });
}

TEST(Bodies, ABlockInsideABodyIsRefused) {
  v1::Simulation settings = emptyTank();
  addBlock(settings, {-0.05, -0.05, -0.05}, 3, 3, 3, {0, 0, 0});
  try {
    const FluidSimulation simulation(settings, listOf({box({0, 0, 0}, {0.5, 0.5, 0.5})}));
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "simulation.fluids[0].blocks[0]");
    EXPECT_THAT(error.problem(), HasSubstr("bodies[0] (wall)"));
  }
}

TEST(Bodies, AMeshThatCannotBeReadIsRefusedAndAnOpenOneNamed) {
  v1::Simulation settings = emptyTank();
  addBlock(settings, {-0.9, -0.9, -0.9}, 3, 3, 3, {0, 0, 0});
  v1::Body missing = tetrahedron({0, 0, 0}, 0.5, false);
  missing.mutable_mesh()->set_path("no_such_file.obj");
  try {
    const FluidSimulation simulation(settings, listOf({missing}));
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), "bodies[0].mesh.path");
  }
  const FluidSimulation open(settings, listOf({tetrahedron({0, 0, 0}, 0.5, true)}));
  EXPECT_THAT(open.notices(), ElementsAre(HasSubstr("do not have two faces")));
  const FluidSimulation closed(settings, listOf({tetrahedron({0, 0, 0}, 0.5, false)}));
  EXPECT_THAT(closed.notices(), testing::IsEmpty());
}

TEST(Bodies, NoBoundaryLoopWithoutAWallNear) {
  v1::Simulation settings = floatingCube(4);
  const auto hasBoundary = [](const FluidSimulation& simulation) {
    const core::Plan plan = simulation.plan();
    return std::ranges::any_of(plan.stages, [](const core::PlannedStage& s) { return s.name == "boundary"; });
  };
  EXPECT_FALSE(hasBoundary(FluidSimulation(settings, listOf({sphere({2, 0, 0}, 0.3)}))));
  EXPECT_TRUE(hasBoundary(FluidSimulation(settings, listOf({sphere({0.5, 0, 0}, 0.3)}))));
}

class EverySolverAtBodies : public testing::TestWithParam<const char*> {
 protected:
  static v1::Simulation tank() {
    v1::Simulation settings = emptyTank();
    const std::string name = GetParam();
    if (name == "iisph") settings.mutable_iisph();
    if (name == "pbf") settings.mutable_pbf();
    if (name == "wcsph") settings.mutable_wcsph();
    return settings;
  }
};

// Loose particles among them, which no pressure stops: the plate is thinner than a fast particle's step.
TEST_P(EverySolverAtBodies, AJetDoesNotGoThroughAPlate) {
  v1::Simulation settings = tank();
  settings.mutable_gravity()->set_y(0);
  settings.mutable_time_step()->set_cfl(1);
  addBlock(settings, {-0.5, -0.1, -0.1}, 5, 5, 5, {8, 0, 0});
  addBlock(settings, {-0.8, 0.4, 0.4}, 1, 1, 1, {8, 0, 0});
  FluidSimulation simulation(settings, listOf({box({0.1, 0, 0}, {0.06, 1.999, 1.999})}));
  runUntil(simulation, 0.25);
  EXPECT_EQ(simulation.halted(), "");
  // With integrated densities even a lone particle is stopped by pressure.
  EXPECT_TRUE(simulation.wallContacts() > 0 || settings.has_wcsph());
  forEachParticle(simulation, [](const Vector3d& x) { EXPECT_LT(x.x(), 0.07); });
}

TEST_P(EverySolverAtBodies, AColumnFallsAroundASphere) {
  v1::Simulation settings = tank();
  addBlock(settings, {-0.1, -0.4, -0.1}, 5, 8, 5, {0, -4, 0});
  FluidSimulation simulation(settings, listOf({sphere({0.01, -0.7, 0.02}, 0.2)}));
  runUntil(simulation, 0.25);
  EXPECT_EQ(simulation.halted(), "");
  forEachParticle(simulation,
                  [](const Vector3d& x) { EXPECT_GT((x - Vector3d(0.01, -0.7, 0.02)).norm(), 0.2 + 0.4 * kSpacing); });
}

INSTANTIATE_TEST_SUITE_P(All, EverySolverAtBodies, testing::Values("dfsph", "iisph", "pbf", "wcsph"),
                         [](const auto& solver) { return std::string(solver.param); });

/// Water that a square column of it leaves in a vessel 0.5 m wide: nobody is outside, the surface is level.
void expectRest(const v1::Body& vessel, int across) {
  v1::Simulation settings = emptyTank();
  const double half = 0.5 * kSpacing * (across - 1);
  addBlock(settings, {-half, -0.35, -half}, across, 10, across, {0, 0, 0});
  FluidSimulation simulation(settings, listOf({vessel}));
  EXPECT_EQ(simulation.state().size(), static_cast<std::size_t>(across * across * 10));
  runUntil(simulation, 2);
  EXPECT_EQ(simulation.halted(), "");
  EXPECT_LT(simulation.statistics().meanDensityError, 2e-3);
  EXPECT_LT(simulation.statistics().maxDensityError, 0.1);
  // The highest particle over each of four quarters.
  std::array<double, 4> top{-1, -1, -1, -1};
  forEachParticle(simulation, [&](const Vector3d& x) {
    EXPECT_LT(std::abs(x.x()), 0.25);
    EXPECT_LT(std::abs(x.z()), 0.25);
    EXPECT_GT(x.y(), -0.4);
    double& highest = top[(x.x() > 0 ? 1U : 0U) + (x.z() > 0 ? 2U : 0U)];
    highest = std::max(highest, x.y());
  });
  const auto [low, high] = std::minmax_element(top.begin(), top.end());
  EXPECT_LT(*high - *low, kSpacing);
  EXPECT_LT(*high, 0.2);
  EXPECT_GT(*low, -0.15);
}

TEST(Bodies, WaterRestsInAnOpenBox) { expectRest(box({0, -0.1, 0}, {0.5, 0.6, 0.5}, true), 9); }
TEST(Bodies, WaterRestsInAnOpenCylinder) { expectRest(cylinder({0, -0.1, 0}, 0.25, 0.6, true), 7); }

/// How fast pressure grows with depth over hydrostatics' ρ0 g, by least squares over particles at rest for which
/// `counts` says so. Next to a wall particles carry about twice the pressure, because a wall answers with κ_i alone and
/// not κ_i + κ_j; they, and the surface, which stands within a spacing of where it should, are to be left out.
template <class Counts>
double pressureGradient(FluidSimulation& simulation, const Counts& counts) {
  runUntil(simulation, 2);
  double n = 0, sumY = 0, sumP = 0, sumYY = 0, sumYP = 0;
  // Over some steps, because single steps flicker about the mean.
  for (int step = 0; step < 40; ++step) {
    EXPECT_TRUE(simulation.advance());
    const auto snapshot = simulation.snapshot();
    for (std::size_t i = 0; i < snapshot->size(); ++i) {
      const Vector3d x = snapshot->positions[i].cast<double>();
      if (!counts(x)) continue;
      const double p = static_cast<double>(snapshot->pressures[i]) / (1000 * 9.81);
      ++n;
      sumY += x.y();
      sumP += p;
      sumYY += x.y() * x.y();
      sumYP += x.y() * p;
    }
  }
  EXPECT_GT(n, 40 * 50) << "too few to tell";
  return -(sumYP - sumY * sumP / n) / (sumYY - sumY * sumY / n);
}

/// 15 %, as of a column in a box: see Physics.PressureInAColumnGrowsWithDepth.
constexpr double kPressureTolerance = 0.15;

TEST(Bodies, PressureGrowsWithDepthInAnOpenCylinder) {
  v1::Simulation settings = emptyTank();
  settings.mutable_dfsph()->set_density_error(0.005);
  addBlock(settings, {-0.25, -0.35, -0.25}, 11, 14, 11, {0, 0, 0});
  FluidSimulation simulation(settings, listOf({cylinder({0, 0.1, 0}, 0.4, 1, true)}));
  const double gradient = pressureGradient(simulation, [](const Vector3d& x) {
    return std::hypot(x.x(), x.z()) < 0.4 - 2.5 * kSpacing && x.y() > -0.4 + 2.5 * kSpacing && x.y() < 0;
  });
  EXPECT_NEAR(gradient, 1, kPressureTolerance);
}

TEST(Bodies, PressureGrowsWithDepthAroundACylinder) {
  v1::Simulation settings = emptyTank();
  settings.mutable_dfsph()->set_density_error(0.005);
  set(settings.mutable_container()->mutable_min(), -0.6, -1, -0.6);
  set(settings.mutable_container()->mutable_max(), 0.6, 1, 0.6);
  addBlock(settings, {-0.55, -0.95, -0.55}, 23, 14, 23, {0, 0, 0});
  FluidSimulation simulation(settings, listOf({cylinder({0, -0.5, 0}, 0.25, 1)}));
  const double gradient = pressureGradient(simulation, [](const Vector3d& x) {
    return std::hypot(x.x(), x.z()) > 0.25 + 2.5 * kSpacing && std::abs(x.x()) < 0.6 - 2.5 * kSpacing &&
           std::abs(x.z()) < 0.6 - 2.5 * kSpacing && x.y() > -1 + 2.5 * kSpacing && x.y() < -0.4;
  });
  EXPECT_NEAR(gradient, 1, kPressureTolerance);
}

TEST(Bodies, OnesThatAreOnlyDrawnHoldNothing) {
  v1::Simulation settings = emptyTank();
  addBlock(settings, {-0.2, -0.9, -0.2}, 9, 9, 9, {0, 0, 0});
  v1::Body drawn = sphere({0, -0.7, 0}, 0.1);
  drawn.set_solid(false);
  const FluidSimulation simulation(settings, listOf({drawn}));
  EXPECT_TRUE(simulation.bodies().empty());
  EXPECT_EQ(simulation.state().size(), 729U);
  EXPECT_EQ(simulation.boundary().size(), FluidSimulation(settings).boundary().size());
}

TEST(Bodies, SameBitsForAnyNumberOfThreads) {
  v1::Simulation settings = emptyTank();
  addBlock(settings, {-0.9, -0.95, -0.9}, 12, 16, 12, {2, 0, 0});
  const Bodies::List bodies = listOf({cylinder({0, -0.7, 0}, 0.15, 0.6), tetrahedron({0.4, -0.6, -0.4}, 0.5, false)});
  const auto after = [&](int threads) {
    FluidSimulation simulation(settings, bodies, {.threads = threads});
    for (int step = 0; step < 60; ++step) EXPECT_TRUE(simulation.advance());
    return simulation.state();
  };
  const ParticleState one = after(1);
  for (const int threads : {2, 4}) EXPECT_TRUE(after(threads) == one) << threads << " threads";
}

}  // namespace
}  // namespace sluice::sim
