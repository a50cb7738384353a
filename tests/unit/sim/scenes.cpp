#include "scenes.h"

namespace sluice::sim {

namespace {

constexpr double kSpacing = 0.05;

void set(v1::Vec3* v, double x, double y, double z) {
  v->set_x(x);
  v->set_y(y);
  v->set_z(z);
}

v1::Block* addBlock(v1::Simulation& simulation, double x, double y, double z, std::uint32_t nx, std::uint32_t ny,
                    std::uint32_t nz) {
  if (simulation.fluids_size() == 0) simulation.add_fluids();
  v1::Block* block = simulation.mutable_fluids(0)->add_blocks();
  set(block->mutable_first_particle(), x, y, z);
  block->set_count_x(nx);
  block->set_count_y(ny);
  block->set_count_z(nz);
  return block;
}

}  // namespace

v1::Simulation floatingCube(std::uint32_t particlesPerEdge) {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, 0, 0);
  set(simulation.mutable_container()->mutable_min(), -5, -5, -5);
  set(simulation.mutable_container()->mutable_max(), 5, 5, 5);
  const double half = 0.5 * kSpacing * (particlesPerEdge - 1);
  addBlock(simulation, -half, -half, -half, particlesPerEdge, particlesPerEdge, particlesPerEdge);
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
  addBlock(simulation, kSpacing, kSpacing, kSpacing, width, layers, width);
  return simulation;
}

v1::Simulation smallDamBreak() {
  v1::Simulation simulation;
  simulation.set_particle_spacing(kSpacing);
  set(simulation.mutable_gravity(), 0, -9.81, 0);
  set(simulation.mutable_container()->mutable_min(), 0, 0, 0);
  set(simulation.mutable_container()->mutable_max(), 1.6, 1.2, 0.8);
  addBlock(simulation, kSpacing, kSpacing, kSpacing, 10, 20, 15);
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

v1::Scene sceneOf(const v1::Simulation& simulation) {
  v1::Scene scene;
  *scene.mutable_simulation() = simulation;
  return scene;
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

}  // namespace sluice::sim
