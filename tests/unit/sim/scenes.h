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

v1::Scene sceneOf(const v1::Simulation& simulation);

/// Positions in the order of the ids.
std::vector<Float4> positionsById(const FluidSimulation& simulation);

/// Advances until `seconds` of simulated time have passed; stops where the simulation halts.
void runUntil(FluidSimulation& simulation, double seconds);

/// ½ Σ v² + Σ g y, per particle, m²/s².
double meanEnergy(const FluidSimulation& simulation);

}  // namespace sluice::sim
