#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "fluid_simulation.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

/// Particle spacing of every scene here, m.
inline constexpr double kSpacing = 0.05;

void set(v1::Vec3* v, double x, double y, double z);
void set(v1::Vec3* v, const Eigen::Vector3d& to);

// ----------------------------------------------------------------------------------------------------------------
// fluid

/// A cube of fluid without gravity and viscosity that floats in the middle of a container it never touches.
v1::Simulation floatingCube(std::uint32_t particlesPerEdge);

/// A column of fluid at rest that fills the floor of a container `width` particles wide.
v1::Simulation column(std::uint32_t width, std::uint32_t layers);

/// A small dam break: 3,000 particles of 0.05 m.
v1::Simulation smallDamBreak();

/// Adds a fluid with one block, and returns its index.
int addFluid(v1::Simulation& simulation, double restDensity, double viscosity, const v1::Block& block);

/// Two cubes of different fluids that collide off-centre, free of walls and gravity.
v1::Simulation collidingFluids(double restDensityRatio);

/// A tank whose lower part is full of one fluid and, above, another; `lower` and `upper` are their rest densities.
v1::Simulation layeredTank(double lower, double upper);

/// An empty container of 3 m about the origin, without gravity, with a nozzle that points along x.
v1::Simulation jet(double radius, double speed);

/// A jet into a pool with a drain in its floor: everything that comes and goes.
v1::Simulation basin();

/// The first fluid's first.
v1::Emitter& emitterOf(v1::Simulation& settings);

void addDrain(v1::Simulation& settings, std::array<double, 3> low, std::array<double, 3> high);

/// 2 m wide, about the origin, with a fluid that has no block yet.
v1::Simulation emptyTank();

/// Adds a block to the first fluid, which it makes where there is none; `velocity` in m/s.
void addBlock(v1::Simulation& simulation, const Eigen::Vector3d& first, std::uint32_t nx, std::uint32_t ny,
              std::uint32_t nz, const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero());

v1::Scene sceneOf(const v1::Simulation& simulation);

// ---------------------------------------------------------------------------------------------------------------
// bodies

v1::Body box(const Eigen::Vector3d& middle, const Eigen::Vector3d& size, bool openTop = false);
v1::Body cylinder(const Eigen::Vector3d& middle, double radius, double height, bool openTop = false);
v1::Body sphere(const Eigen::Vector3d& middle, double radius);

/// A tetrahedron with edges of `edge` m, read from a file, without its last face where it is open.
v1::Body tetrahedron(const Eigen::Vector3d& middle, double edge, bool open);

Bodies::List listOf(std::initializer_list<v1::Body> bodies);

// -----------------------------------------------------------------------------------------------------------
// simulations

/// Expects that no simulation of it can be made, and that the error tells the field and the reason.
void expectRefused(const v1::Simulation& settings, const std::string& fieldPath, const std::string& reason);

/// Takes so many steps; a failure of the test where one is not taken.
void advance(FluidSimulation& simulation, int steps);

/// All that the next steps depend on.
std::vector<std::uint8_t> saved(const FluidSimulation& simulation);

/// Calls `check` with where each particle is in the scene.
template <class Check>
void forEachParticle(const FluidSimulation& simulation, Check&& check) {
  const auto snapshot = simulation.snapshot();
  for (const Eigen::Vector3f& x : snapshot->positions) check(Eigen::Vector3d(x.cast<double>()));
}

/// Positions in the order of the ids.
std::vector<Float4> positionsById(const FluidSimulation& simulation);

/// Advances until `seconds` of simulated time have passed; stops where the simulation halts.
void runUntil(FluidSimulation& simulation, double seconds);

/// ½ Σ v² + Σ g y, per particle, m²/s².
double meanEnergy(const FluidSimulation& simulation);

/// How fast pressure grows with depth over hydrostatics' ρ0 g, by least squares over 40 steps and the particles at rest
/// for which `counts` says so. Those next to a wall, and at the surface, which stands within a spacing of where it
/// should, are to be left out.
double pressureGradient(FluidSimulation& simulation, const std::function<bool(const Eigen::Vector3d&)>& counts);

}  // namespace sluice::sim
