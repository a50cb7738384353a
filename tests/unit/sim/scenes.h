#pragma once

#include <vector>

#include "fluid_simulation.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::sim {

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

v1::Scene sceneOf(const v1::Simulation& simulation);

/// Positions in the order of the ids.
std::vector<Float4> positionsById(const FluidSimulation& simulation);

/// Advances until `seconds` of simulated time have passed; stops where the simulation halts.
void runUntil(FluidSimulation& simulation, double seconds);

/// ½ Σ v² + Σ g y, per particle, m²/s².
double meanEnergy(const FluidSimulation& simulation);

}  // namespace sluice::sim
