#include "bodies.h"

#include <algorithm>
#include <cmath>
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
  v1::Body body = sphere({0, -0.7, 0}, 0.1);
  body.set_name("wall");
  const FluidSimulation simulation(settings, listOf({body}));
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
  v1::Body body = box({0, 0, 0}, {0.5, 0.5, 0.5});
  body.set_name("wall");
  try {
    const FluidSimulation simulation(settings, listOf({body}));
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
