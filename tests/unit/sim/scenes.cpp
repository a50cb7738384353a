#include "scenes.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sluice/core/input_error.h"
#include "sluice/core/state_stream.h"

namespace sluice::sim {

using Eigen::Vector3d;
using testing::HasSubstr;

namespace {

v1::Body bodyAt(const Vector3d& middle) {
  v1::Body body;
  set(body.mutable_position(), middle);
  return body;
}

}  // namespace

void set(v1::Vec3* v, double x, double y, double z) {
  v->set_x(x);
  v->set_y(y);
  v->set_z(z);
}

void set(v1::Vec3* v, const Vector3d& to) {
  v->set_x(to.x());
  v->set_y(to.y());
  v->set_z(to.z());
}

v1::Simulation floatingCube(std::uint32_t particlesPerEdge) {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, 0, 0);
  set(simulation.mutable_container()->mutable_min(), -5, -5, -5);
  set(simulation.mutable_container()->mutable_max(), 5, 5, 5);
  const double half = 0.5 * kSpacing * (particlesPerEdge - 1);
  addBlock(simulation, {-half, -half, -half}, particlesPerEdge, particlesPerEdge, particlesPerEdge);
  simulation.mutable_fluids(0)->set_viscosity(0);
  return simulation;
}

v1::Simulation column(std::uint32_t width, std::uint32_t layers) {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, -9.81, 0);
  set(simulation.mutable_container()->mutable_min(), 0, 0, 0);
  const double side = kSpacing * (width + 1);
  set(simulation.mutable_container()->mutable_max(), side, 2 * kSpacing * layers, side);
  addBlock(simulation, {kSpacing, kSpacing, kSpacing}, width, layers, width);
  return simulation;
}

v1::Simulation smallDamBreak() {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, -9.81, 0);
  set(simulation.mutable_container()->mutable_min(), 0, 0, 0);
  set(simulation.mutable_container()->mutable_max(), 1.6, 1.2, 0.8);
  addBlock(simulation, {kSpacing, kSpacing, kSpacing}, 10, 20, 15);
  return simulation;
}

int addFluid(v1::Simulation& simulation, double restDensity, double viscosity, const v1::Block& block) {
  v1::Fluid* fluid = simulation.add_fluids();
  fluid->set_rest_density(restDensity);
  fluid->set_viscosity(viscosity);
  *fluid->add_blocks() = block;
  return simulation.fluids_size() - 1;
}

v1::Simulation collidingFluids(double restDensityRatio) {
  v1::Simulation simulation = floatingCube(10);
  v1::Fluid* left = simulation.mutable_fluids(0);
  left->set_viscosity(0.01);
  left->set_rest_density(1000 * restDensityRatio);
  v1::Block right = left->blocks(0);
  left->mutable_blocks(0)->mutable_first_particle()->set_x(-0.55);
  left->mutable_blocks(0)->mutable_velocity()->set_x(2);
  right.mutable_first_particle()->set_x(0.05);
  right.mutable_first_particle()->set_y(right.first_particle().y() + 0.2);
  right.mutable_velocity()->set_x(-1);
  addFluid(simulation, 1000, 0.002, right);
  return simulation;
}

v1::Simulation layeredTank(double lower, double upper) {
  v1::Simulation simulation = column(10, 8);
  simulation.mutable_container()->mutable_max()->set_y(1.2);
  v1::Block above = simulation.fluids(0).blocks(0);
  above.mutable_first_particle()->set_y(kSpacing + 8 * kSpacing);
  simulation.mutable_fluids(0)->set_rest_density(lower);
  addFluid(simulation, upper, 0.01, above);
  return simulation;
}

v1::Simulation jet(double radius, double speed) {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, 0, 0);
  set(simulation.mutable_container()->mutable_min(), -1.5, -1.5, -1.5);
  set(simulation.mutable_container()->mutable_max(), 1.5, 1.5, 1.5);
  v1::Emitter* emitter = simulation.add_fluids()->add_emitters();
  set(emitter->mutable_position(), -1.2, 0, 0);
  set(emitter->mutable_direction(), 1, 0, 0);
  emitter->set_radius(radius);
  emitter->set_speed(speed);
  return simulation;
}

v1::Emitter& emitterOf(v1::Simulation& settings) { return *settings.mutable_fluids(0)->mutable_emitters(0); }

void addDrain(v1::Simulation& settings, std::array<double, 3> low, std::array<double, 3> high) {
  v1::Box* box = settings.add_drains()->mutable_box();
  set(box->mutable_min(), low[0], low[1], low[2]);
  set(box->mutable_max(), high[0], high[1], high[2]);
}

v1::Simulation basin() {
  v1::Simulation settings = jet(0.11, 3);
  settings.mutable_gravity()->set_y(-9.81);
  set(settings.mutable_container()->mutable_min(), -0.6, 0, -0.4);
  set(settings.mutable_container()->mutable_max(), 0.6, 1.2, 0.4);
  set(emitterOf(settings).mutable_position(), 0, 1, 0);
  set(emitterOf(settings).mutable_direction(), 0.2, -1, 0);
  v1::Block* pool = settings.mutable_fluids(0)->add_blocks();
  set(pool->mutable_first_particle(), -0.55, kSpacing, -0.35);
  pool->set_count_x(23);
  pool->set_count_y(3);
  pool->set_count_z(15);
  addDrain(settings, {-0.6, 0, -0.4}, {-0.4, 0.12, 0.4});
  return settings;
}

v1::Simulation emptyTank() {
  v1::Simulation simulation = smallDamBreak();
  set(simulation.mutable_container()->mutable_min(), -1, -1, -1);
  set(simulation.mutable_container()->mutable_max(), 1, 1, 1);
  simulation.mutable_fluids(0)->clear_blocks();
  return simulation;
}

void addBlock(v1::Simulation& simulation, const Vector3d& first, std::uint32_t nx, std::uint32_t ny, std::uint32_t nz,
              const Vector3d& velocity) {
  if (simulation.fluids_size() == 0) simulation.add_fluids();
  v1::Block* block = simulation.mutable_fluids(0)->add_blocks();
  set(block->mutable_first_particle(), first);
  block->set_count_x(nx);
  block->set_count_y(ny);
  block->set_count_z(nz);
  set(block->mutable_velocity(), velocity);
}

v1::Scene sceneOf(const v1::Simulation& simulation) {
  v1::Scene scene;
  *scene.mutable_simulation() = simulation;
  return scene;
}

v1::Body box(const Vector3d& middle, const Vector3d& size, bool openTop) {
  v1::Body body = bodyAt(middle);
  set(body.mutable_box()->mutable_size(), size);
  body.mutable_box()->set_open_top(openTop);
  return body;
}

v1::Body cylinder(const Vector3d& middle, double radius, double height, bool openTop) {
  v1::Body body = bodyAt(middle);
  body.mutable_cylinder()->set_radius(radius);
  body.mutable_cylinder()->set_height(height);
  body.mutable_cylinder()->set_open_top(openTop);
  return body;
}

v1::Body sphere(const Vector3d& middle, double radius) {
  v1::Body body = bodyAt(middle);
  body.mutable_sphere()->set_radius(radius);
  return body;
}

v1::Body tetrahedron(const Vector3d& middle, double edge, bool open) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / (open ? "open_tetrahedron.obj" : "tetrahedron.obj");
  std::ofstream(file) << "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\n"
                      << (open ? "" : "f 2 4 3\n");
  v1::Body body = bodyAt(middle);
  body.mutable_mesh()->set_path(file.string());
  body.mutable_mesh()->set_scale(edge / std::sqrt(8));
  return body;
}

Bodies::List listOf(std::initializer_list<v1::Body> bodies) {
  Bodies::List list;
  for (const v1::Body& body : bodies) *list.Add() = body;
  return list;
}

void expectRefused(const v1::Simulation& settings, const std::string& fieldPath, const std::string& reason) {
  try {
    const FluidSimulation simulation(settings);
    FAIL() << "taken, though " << reason;
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.fieldPath(), fieldPath);
    EXPECT_THAT(error.problem(), HasSubstr(reason));
  }
}

void advance(FluidSimulation& simulation, int steps) {
  for (int step = 0; step < steps; ++step) ASSERT_TRUE(simulation.advance()) << simulation.halted();
}

std::vector<std::uint8_t> saved(const FluidSimulation& simulation) {
  core::StateWriter out;
  simulation.save(out);
  return out.bytes();
}

std::vector<Float4> positionsById(const FluidSimulation& simulation) {
  const ParticleState& state = simulation.state();
  std::vector<Float4> positions(state.size());
  for (std::size_t i = 0; i < state.size(); ++i) positions[state.id[i]] = state.position[i];
  return positions;
}

void runUntil(FluidSimulation& simulation, double seconds) {
  while (simulation.time() < seconds && simulation.advance()) {
  }
}

double meanEnergy(const FluidSimulation& simulation) {
  const ParticleState& state = simulation.state();
  double energy = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Float4& v = state.velocity[i];
    energy += 0.5 * (v.x * v.x + v.y * v.y + v.z * v.z) + 9.81 * state.position[i].y;
  }
  return energy / static_cast<double>(state.size());
}

double pressureGradient(FluidSimulation& simulation, const std::function<bool(const Eigen::Vector3d&)>& counts) {
  double n = 0, sumY = 0, sumP = 0, sumYY = 0, sumYP = 0;
  // Over some steps, because single steps flicker about the mean.
  for (int step = 0; step < 40; ++step) {
    EXPECT_TRUE(simulation.advance());
    const auto snapshot = simulation.snapshot();
    for (std::size_t i = 0; i < snapshot->size(); ++i) {
      const Eigen::Vector3d x = snapshot->positions[i].cast<double>();
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

}  // namespace sluice::sim
