// Nozzles and the bodies that come before their mouths.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"
#include "sluice/core/input_error.h"

namespace sluice::sim {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.05;

void set(v1::Vec3* v, const Vector3d& to) {
  v->set_x(to.x());
  v->set_y(to.y());
  v->set_z(to.z());
}

/// A nozzle in an empty container of 3 m about the origin that points along x from x = -1.2 m.
v1::Simulation jet(double speed) {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), Vector3d::Zero());
  set(simulation.mutable_container()->mutable_min(), Vector3d::Constant(-1.5));
  set(simulation.mutable_container()->mutable_max(), Vector3d::Constant(1.5));
  v1::Emitter* emitter = simulation.add_fluids()->add_emitters();
  set(emitter->mutable_position(), {-1.2, 0, 0});
  set(emitter->mutable_direction(), Vector3d::UnitX());
  emitter->set_radius(0.12);
  emitter->set_speed(speed);
  return simulation;
}

v1::Body box(const Vector3d& middle, const Vector3d& size) {
  v1::Body body;
  set(body.mutable_position(), middle);
  set(body.mutable_box()->mutable_size(), size);
  return body;
}

Bodies::List listOf(const v1::Body& body) {
  Bodies::List list;
  *list.Add() = body;
  return list;
}

bool isInside(const v1::Body& body, const MovingBodies& moving, const Float4& x) {
  const Vector3d place(x.x, x.y, x.z);
  if (moving.size() > 0) return moving.body(0).contains(place);
  // In the container's coordinates.
  const Vector3d from =
      place - Vector3d::Constant(1.5) - Vector3d(body.position().x(), body.position().y(), body.position().z());
  const v1::Vec3& size = body.box().size();
  return (from.array().abs() < 0.5 * Vector3d(size.x(), size.y(), size.z()).array()).all();
}

struct Course {
  std::uint64_t early = 0;  ///< Particles given within the first 0.2 s.
  std::uint64_t given = 0;  ///< Within 1.5 s.
  double worst = 0;         ///< Largest compression of any particle.
};

/// Runs a nozzle of 1 m/s before a body; no particle may ever be in it.
Course courseOf(const v1::Body& body, const v1::Simulation& settings) {
  FluidSimulation simulation(settings, listOf(body));
  Course course;
  while (simulation.time() < 1.5) {
    if (!simulation.advance()) {
      ADD_FAILURE() << simulation.halted();
      break;
    }
    for (const Float4& x : simulation.state().position) {
      if (!isInside(body, simulation.movingBodies(), x)) continue;
      ADD_FAILURE() << "a particle at " << x.x - 1.5F << ", " << x.y - 1.5F << ", " << x.z - 1.5F
                    << " m is in the body at " << simulation.time() << " s";
      return course;
    }
    if (simulation.time() < 0.2) course.early = simulation.population().emitted();
    course.worst = std::max(course.worst, simulation.statistics().maxDensityError);
  }
  course.given = simulation.population().emitted();
  return course;
}

/// What leaves the nozzle where nothing is before it.
std::uint64_t unhindered() {
  FluidSimulation simulation(jet(1));
  runUntil(simulation, 1.5);
  return simulation.population().emitted();
}

// It covers the mouth, goes away, and comes back a period later.
TEST(EmitterAndBody, WaitsBehindAPaddleUntilItIsGone) {
  v1::Body paddle = box({-1.2, 0, 0}, {0.2, 0.6, 0.6});
  paddle.mutable_driven()->mutable_sway()->set_y(-0.9);
  paddle.mutable_driven()->set_period_seconds(2);
  const Course course = courseOf(paddle, jet(1));
  EXPECT_EQ(course.early, 0U);
  EXPECT_GT(course.given, unhindered() / 4);
  EXPECT_LT(course.given, unhindered() * 3 / 4);
}

// It starts elsewhere, where it hinders nobody, and sweeps past the mouth.
TEST(EmitterAndBody, DoesNotEmitIntoAPaddleThatComes) {
  v1::Body paddle = box({-1.13, 0.8, 0}, {0.1, 0.6, 0.6});
  paddle.mutable_driven()->mutable_sway()->set_y(-0.9);
  paddle.mutable_driven()->set_period_seconds(1.5);
  const Course course = courseOf(paddle, jet(1));
  EXPECT_GT(course.early, 0U);
  EXPECT_LT(course.given, unhindered());
  EXPECT_LT(course.worst, 0.5);
}

// A box falls past the mouth.
TEST(EmitterAndBody, DoesNotEmitIntoAFloatingBox) {
  v1::Simulation settings = jet(1);
  settings.mutable_gravity()->set_y(-9.81);
  v1::Body cork = box({-1.1, 0.5, 0}, {0.3, 0.3, 0.3});
  cork.mutable_floating()->set_density(400);
  const Course course = courseOf(cork, settings);
  EXPECT_GT(course.given, unhindered() / 2);
}

TEST(EmitterAndBody, PushesAFloatingBoxAwayFromItsMouth) {
  v1::Body cork = box({-1.2, 0, 0}, {0.3, 0.3, 0.3});
  set(cork.mutable_floating()->mutable_velocity(), {0.8, 0, 0});
  cork.mutable_floating()->set_density(400);
  const Course course = courseOf(cork, jet(2));
  EXPECT_EQ(course.early, 0U) << "the box stands in the mouth";
  EXPECT_GT(course.given, unhindered() / 2);
}

// Nearer to the mouth than layers are led on.
TEST(EmitterAndBody, DoesNotEmitIntoABodyBeforeTheMouth) {
  for (const double friction : {0.0, 0.3}) {
    v1::Body wall = box({-1.0, 0, 0}, {0.25, 0.8, 0.8});
    wall.set_friction(friction);
    const Course course = courseOf(wall, jet(1));
    EXPECT_GT(course.given, 20U);
    EXPECT_LT(course.worst, 1);
  }
}

TEST(EmitterAndBody, AMouthInABodyThatNeverMovesIsRefusedWhateverIsFeltOfIt) {
  v1::Body wall = box({-1.2, 0, 0}, {0.25, 0.8, 0.8});
  EXPECT_THROW(FluidSimulation(jet(1), listOf(wall)), core::InputError);
  wall.set_friction(0.3);
  EXPECT_THROW(FluidSimulation(jet(1), listOf(wall)), core::InputError);
}

TEST(EmitterAndBody, BodiesMoveBeforeThereIsAParticle) {
  v1::Simulation settings = jet(1);
  settings.mutable_gravity()->set_y(-9.81);
  settings.mutable_fluids(0)->mutable_emitters(0)->set_start_seconds(10);
  v1::Body cork = box({0.5, 1, 0}, {0.3, 0.3, 0.3});
  cork.mutable_floating()->set_density(400);
  FluidSimulation simulation(settings, listOf(cork));
  simulation.stopAt(0.4);
  runUntil(simulation, 0.4);
  ASSERT_EQ(simulation.state().size(), 0U);
  EXPECT_NEAR(simulation.movingBodies().centre(0).y(), 2.5 - 0.5 * 9.81 * 0.4 * 0.4, 0.03);
}

}  // namespace
}  // namespace sluice::sim
